/* The reference of all commands, flags and settings, made from their tables. */
#ifndef CS_PROGRAM_COMMANDS_REFERENCE_H
#define CS_PROGRAM_COMMANDS_REFERENCE_H

/* Prints it: `format` is "md" (Markdown) or "man" (a page of section 1). Returns the exit status.
 */
int print_reference(const char *format);

#endif
