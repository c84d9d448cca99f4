/* clshear: enumerations of the settings with named choices, from the lists in setting_list.h:
 * CLSHEAR_SHEAR_NONE is the line NONE of CLSHEAR_SHEAR_LIST. */
#ifndef CLSHEAR_CHOICES_H
#define CLSHEAR_CHOICES_H

#include "setting_list.h"

typedef enum clshear_shear {
#define CLSHEAR_CHOICE(identifier, number, name, meaning) CLSHEAR_SHEAR_##identifier = number,
    CLSHEAR_SHEAR_LIST(CLSHEAR_CHOICE)
#undef CLSHEAR_CHOICE
} clshear_shear;

typedef enum clshear_oracle {
#define CLSHEAR_CHOICE(identifier, number, name, meaning) CLSHEAR_ORACLE_##identifier = number,
    CLSHEAR_ORACLE_LIST(CLSHEAR_CHOICE)
#undef CLSHEAR_CHOICE
} clshear_oracle;

typedef enum clshear_filter {
#define CLSHEAR_CHOICE(identifier, number, name, meaning) CLSHEAR_FILTER_##identifier = number,
    CLSHEAR_FILTER_LIST(CLSHEAR_CHOICE)
#undef CLSHEAR_CHOICE
} clshear_filter;

typedef enum clshear_aperture {
#define CLSHEAR_CHOICE(identifier, number, name, meaning) CLSHEAR_APERTURE_##identifier = number,
    CLSHEAR_APERTURE_LIST(CLSHEAR_CHOICE)
#undef CLSHEAR_CHOICE
} clshear_aperture;

/* Any number of them: pass an array to clshear_settings_set_numbers, or names separated by commas
 * to clshear_settings_set_text. */
typedef enum clshear_aov {
#define CLSHEAR_CHOICE(identifier, number, name, meaning) CLSHEAR_AOV_##identifier = number,
    CLSHEAR_AOV_LIST(CLSHEAR_CHOICE)
#undef CLSHEAR_CHOICE
} clshear_aov;

typedef enum clshear_emitters {
#define CLSHEAR_CHOICE(identifier, number, name, meaning) CLSHEAR_EMITTERS_##identifier = number,
    CLSHEAR_EMITTERS_LIST(CLSHEAR_CHOICE)
#undef CLSHEAR_CHOICE
} clshear_emitters;

typedef enum clshear_tone {
#define CLSHEAR_CHOICE(identifier, number, name, meaning) CLSHEAR_TONE_##identifier = number,
    CLSHEAR_TONE_LIST(CLSHEAR_CHOICE)
#undef CLSHEAR_CHOICE
} clshear_tone;

#endif
