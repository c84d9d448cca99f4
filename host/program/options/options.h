/* The one way from words to values. A flag is a setting of the library, which has a table of them,
 * or a row of a table of the command. */
#ifndef CS_PROGRAM_OPTIONS_OPTIONS_H
#define CS_PROGRAM_OPTIONS_OPTIONS_H

#include <clshear/clshear.h>

enum {
    MOST_TEXTS = 16,
    MOST_NUMBERS = 32
};

typedef enum flag_kind {
    FLAG_SWITCH, /* an int, which becomes 1 */
    FLAG_TEXT,   /* a text_list */
    FLAG_WHOLE,  /* a number_list of whole numbers */
    FLAG_NUMBER  /* a number_list */
} flag_kind;

/* What was given; count 0: nothing. */
typedef struct text_list {
    size_t count;
    const char *items[MOST_TEXTS];
} text_list;

typedef struct number_list {
    size_t count;
    double items[MOST_NUMBERS];
} number_list;

typedef struct program_flag {
    const char *names;    /* separated by spaces, the main one first, without dashes */
    const char *argument; /* shown in the help; "" for a switch */
    const char *help;
    const char *fallback; /* value when the flag is not given; "": none */
    flag_kind kind;
    size_t target; /* offset of the value in the struct that begins with program_options */
    int adds;      /* 1: each time the flag is given adds to the list; 0: the last time counts */
    size_t values; /* numbers in an item, with commas between; more than one: ";" between items */
    size_t most;   /* items */
    double low;    /* bounds of each number */
    double high;
    const char *form; /* texts that are allowed: words, or endings of names; "": all */
} program_flag;

#define SWITCH_FLAG(names, help, target)                            \
    {                                                               \
        names, "", help, "", FLAG_SWITCH, target, 0, 1, 1, 0, 0, "" \
    }
#define TEXT_FLAG(names, argument, help, fallback, target, form)                \
    {                                                                           \
        names, argument, help, fallback, FLAG_TEXT, target, 0, 1, 1, 0, 0, form \
    }
#define FILES_FLAG(names, help, fallback, target, form)                                \
    {                                                                                  \
        names, "FILE", help, fallback, FLAG_TEXT, target, 1, 1, MOST_TEXTS, 0, 0, form \
    }
#define NUMBER_FLAG(names, argument, help, fallback, target, values, most, low, high)        \
    {                                                                                        \
        names, argument, help, fallback, FLAG_NUMBER, target, 0, values, most, low, high, "" \
    }
#define WHOLE_FLAG(names, argument, help, fallback, target, values, most, low, high)        \
    {                                                                                       \
        names, argument, help, fallback, FLAG_WHOLE, target, 0, values, most, low, high, "" \
    }

/* What all commands have; the struct that the flags of a command fill begins with it. */
typedef struct program_options {
    clshear_settings *settings;
    const char *scene;  /* NULL: none */
    const char **files; /* of a command that takes them */
    size_t file_count;
    text_list settings_file;
    const char *file; /* the settings file that was read; NULL: none */
    int quiet;
    int help;
    int word_count; /* of the line */
    char **words;
    const char *file_words; /* what the settings file says, as words of a line; NULL: no file */
    struct kept_text *kept; /* texts that live as long as the options */
} program_options;

typedef struct program_command {
    const char *name;  /* "": the program itself, which renders */
    const char *usage; /* lines after "usage: " up to the flags */
    const char *notes; /* lines after the flags */
    const program_flag *flags;
    size_t flag_count;
    const clshear_setting *settings; /* those that it takes; NULL: all */
    size_t setting_count;
    int takes_scene;
    int takes_files;       /* any number, instead of a scene */
    size_t job_size;       /* of the struct that its flags fill */
    int (*run)(void *job); /* returns the exit status */
} program_command;

/* Members of a program_command that point to a table of flags, or of settings. */
#define COMMAND_FLAGS(table) .flags = table, .flag_count = sizeof table / sizeof *table
#define COMMAND_SETTINGS(table) .settings = table, .setting_count = sizeof table / sizeof *table

/* A flag of a command: a row of a table, or a setting. */
typedef struct named_flag {
    const program_flag *row; /* NULL: the setting */
    clshear_setting_info setting;
} named_flag;

/* Number `index` of all flags of a command: its own, those of all commands, the settings that its
 * own do not hide. Returns 0 past the last one. */
int command_flag(const program_command *command, size_t index, named_flag *flag);

/* Reads the words argv[1] ... and the settings file that they name or that lies beside the scene,
 * over which the words win. `options`, zeros at first, begin the struct of the command's flags.
 * What is wrong is printed in one line. Returns EXIT_DONE, EXIT_FAILED or EXIT_USAGE.
 *
 * A settings file may have flags of `renders`, the program itself, which other commands leave out.
 * They take the settings, and their own flags but outputs. */
int options_parse(const program_command *command, const program_command *renders, int argc,
                  char **argv, program_options *options);
void options_free(program_options *options);

/* Stores a value where the row wants it. Returns whether it is what it must be. */
int flag_store(program_options *options, const program_flag *row, const char *text);

/* What a value must be, in words. */
const char *flag_expectation(program_options *options, const program_flag *row);

/* Formatted text that lives as long as the options. */
const char *options_text(program_options *options, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
