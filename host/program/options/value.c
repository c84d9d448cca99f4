#include "options/options.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "report/words.h"

typedef struct kept_text {
    struct kept_text *next;
    char text[];
} kept_text;

const char *options_text(program_options *options, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    kept_text *kept = malloc(sizeof *kept + (size_t)length + 1);
    if (kept == NULL) return "";
    va_start(arguments, format);
    vsnprintf(kept->text, (size_t)length + 1, format, arguments);
    va_end(arguments);
    kept->next = options->kept;
    options->kept = kept;
    return kept->text;
}

void options_free(program_options *options)
{
    clshear_settings_free(options->settings);
    free(options->files);
    while (options->kept != NULL) {
        kept_text *next = options->kept->next;
        free(options->kept);
        options->kept = next;
    }
}

static const char blanks[] = " \t"; /* may stand around commas and semicolons */

static int store_numbers(const program_flag *row, number_list *list, const char *text)
{
    if (!row->adds) list->count = 0;
    while (list->count < row->values * row->most) {
        char *end;
        const double number = strtod(text, &end);
        if (end == text || isspace((unsigned char)*text)) return 0;
        if (!(number >= row->low && number <= row->high)) return 0;
        if (row->kind == FLAG_WHOLE && number != floor(number)) return 0;
        list->items[list->count++] = number;
        const int item_ends = list->count % row->values == 0;
        if (*end == '\0') return item_ends;
        end += strspn(end, blanks);
        if (*end != (item_ends && row->values > 1 ? ';' : ',')) return 0;
        text = end + 1 + strspn(end + 1, blanks);
    }
    return 0;
}

/* Lists that no repetition adds to have commas. */
static int store_texts(program_options *options, const program_flag *row, text_list *list,
                       const char *text)
{
    const int is_split = !row->adds && row->most > 1;
    if (!row->adds) list->count = 0;
    while (list->count < row->most) {
        const size_t length = is_split ? strcspn(text, ", \t") : strlen(text);
        const char *item = options_text(options, "%.*s", (int)length, text);
        list->items[list->count++] = item;
        if (length == 0) return 0;
        /* A form lists words, or endings, which are no names by themselves. */
        const int is_word = *item != '.' && has_word(row->form, item, length);
        if (*row->form != '\0' && !is_word && !has_ending(row->form, item)) return 0;
        text += length;
        if (*text == '\0') return 1;
        text += strspn(text, blanks);
        if (*text != ',') return 0;
        text += 1 + strspn(text + 1, blanks);
    }
    return 0;
}

int flag_store(program_options *options, const program_flag *row, const char *text)
{
    void *target = (char *)options + row->target;
    if (row->kind == FLAG_TEXT) return store_texts(options, row, target, text);
    if (row->kind != FLAG_SWITCH) return store_numbers(row, target, text);
    *(int *)target = 1;
    return 1;
}

const char *flag_expectation(program_options *options, const program_flag *row)
{
    const char *what = row->kind == FLAG_WHOLE ? "whole number" : "number";
    const char *more = row->adds ? "; given at most 16 times" : "";
    const char *form = *row->form == '-' ? row->form + 2 : row->form;
    if (row->kind == FLAG_TEXT && *form == '\0') return "a text that is not empty";
    char words[256];
    write_words(form, words, sizeof words);
    if (row->kind == FLAG_TEXT && *form != '.') return options_text(options, "%s", words);
    if (row->kind == FLAG_TEXT)
        return options_text(options, "%sa name that ends in %s%s", form != row->form ? "- or " : "",
                            words, more);
    return options_text(options, "%s%sa %s, %.10g to %.10g",
                        row->values * row->most > 1 ? row->argument : "",
                        row->values * row->most > 1 ? ", each " : "", what, row->low, row->high);
}
