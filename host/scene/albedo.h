/* The table of albedos by which layers of a surface pass on light. */
#ifndef CS_SCENE_ALBEDO_H
#define CS_SCENE_ALBEDO_H

/* CS_ALBEDO_FLOATS numbers, see cs_albedo_at. */
extern const float cs_albedo_table[];

#endif
