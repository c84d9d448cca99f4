#include "cli/flags.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Reads `count` numbers separated by commas; 0 if there are more, fewer or other things. */
int cli_read_numbers(const char *text, int count, double *values)
{
    for (int i = 0; i < count; i++) {
        char *end;
        values[i] = strtod(text, &end);
        if (end == text || !isfinite(values[i])) return 0;
        if (*end != (i + 1 < count ? ',' : '\0')) return 0;
        text = end + 1;
    }
    return 1;
}

int cli_read_floats(const char *text, int count, float *values)
{
    double numbers[8];
    if (!cli_read_numbers(text, count, numbers)) return 0;
    for (int i = 0; i < count; i++) {
        values[i] = (float)numbers[i];
        if (!isfinite(values[i])) return 0;
    }
    return 1;
}

int cli_read_ints(const char *text, int count, double low, double high, int *values)
{
    double numbers[8];
    if (!cli_read_numbers(text, count, numbers)) return 0;
    for (int i = 0; i < count; i++) {
        if (numbers[i] < low || numbers[i] > high || numbers[i] != floor(numbers[i])) return 0;
        values[i] = (int)numbers[i];
    }
    return 1;
}

int cli_read_count(const char *text, double low, uint32_t *value)
{
    double number;
    if (!isdigit((unsigned char)*text) || !cli_read_numbers(text, 1, &number)) return 0;
    if (number < low || number > 4294967295.0 || number != floor(number)) return 0;
    *value = (uint32_t)number;
    return 1;
}

const char *cli_read_sides(const char *text, int *sides)
{
    if (cli_read_ints(text, 1, 2, 8192, sides)) {
        sides[1] = sides[0];
        return NULL;
    }
    return cli_read_ints(text, 2, 2, 8192, sides) ? NULL : "R or W,H, each 2 to 8192";
}

const char *cli_check_sampler(const char *name)
{
    clshear_sampler_info info;
    for (size_t i = 0; clshear_sampler_describe(i, &info); i++)
        if (strcmp(name, info.name) == 0) return NULL;
    return "a name from --list-samplers";
}

const char *cli_read_shear(const char *text, clshear_shear *shear)
{
    static const char *const names[] = {"none", "toroidal", "equal-area"};
    static const clshear_shear kinds[] = {CLSHEAR_SHEAR_NONE, CLSHEAR_SHEAR_TOROIDAL,
                                          CLSHEAR_SHEAR_EQUAL_AREA};
    for (int i = 0; i < 3; i++)
        if (strcmp(text, names[i]) == 0) {
            *shear = kinds[i];
            return NULL;
        }
    return "equal-area, toroidal or none";
}

const cli_flag *cli_find_flag(const cli_command *command, const char *name, size_t length)
{
    for (size_t i = 0; i < command->flag_count; i++) {
        const char *known = command->flags[i].names;
        while (*known != '\0') {
            size_t size = strcspn(known, " ");
            if (size == length && strncmp(known, name, size) == 0) return &command->flags[i];
            known += size;
            known += strspn(known, " ");
        }
    }
    return NULL;
}

void cli_print_help(const cli_command *command)
{
    printf("%s\n", command->summary);
    for (size_t i = 0; i < command->flag_count; i++) {
        char left[40];
        const cli_flag *flag = &command->flags[i];
        snprintf(left, sizeof left, "--%.*s %s", (int)strcspn(flag->names, " "), flag->names,
                 flag->argument != NULL ? flag->argument : "");
        printf("  %-24s %s\n", left, flag->help);
    }
    printf("\n%s", command->notes);
}
