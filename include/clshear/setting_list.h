/* clshear: the table of settings.
 *
 * Every option of a render has one line here. The enumerations of settings.h and choices.h, the
 * bounds of the setters, the program's flags, help and manual page, settings files, image metadata,
 * and the check of a continued render are made from this table. A new setting is one line here and
 * the code that implements it. */
#ifndef CLSHEAR_SETTING_LIST_H
#define CLSHEAR_SETTING_LIST_H

/* ------------------------------------------------------------------------------------------------
 * Choices: X(identifier, number, name, meaning). Numbers begin at 0 and have no gaps.
 * --------------------------------------------------------------------------------------------- */

#define CLSHEAR_SHEAR_LIST(X)                                                          \
    X(NONE, 0, "none", "samples are not sheared, as in other renderers")               \
    X(TOROIDAL, 1, "toroidal", "along the fibre, wrapped around at the pixel's edges") \
    X(EQUAL_AREA, 2, "equal-area",                                                     \
      "the first pair of the tuple becomes the fibre's place; no seams")

#define CLSHEAR_ORACLE_LIST(X)                                                                 \
    X(CENTRE, 0, "centre", "the depth seen through the middles of pixel and lens")             \
    X(MEDIAN, 1, "median", "the median depth of rays all over pixel and lens")                 \
    X(NEAR, 2, "near", "the nearest depth of these rays")                                      \
    X(FAR, 3, "far", "the farthest depth of these rays")                                       \
    X(PILOT, 4, "pilot",                                                                       \
      "a small render tries centre, near, far and no shear, and takes the clearly best rule; " \
      "the default if something moves")                                                        \
    X(EDGE, 5, "edge",                                                                         \
      "the mean of what stands in front where a pixel sees depths that lie apart, else centre")

#define CLSHEAR_FILTER_LIST(X)                                                       \
    X(BOX, 0, "box", "constant; usual width 1 px")                                   \
    X(TENT, 1, "tent", "falls linearly to 0; usual width 2 px")                      \
    X(GAUSSIAN, 2, "gaussian", "cut at three standard deviations; usual width 3 px") \
    X(BLACKMAN_HARRIS, 3, "blackman-harris", "four terms; usual width 3 px")

#define CLSHEAR_APERTURE_LIST(X)                                                      \
    X(DISK, 0, "disk", "a disk of the lens radius")                                   \
    X(SQUARE, 1, "square", "a square of side twice the lens radius")                  \
    X(POLYGON, 2, "polygon", "a regular polygon with its corners at the lens radius") \
    X(IMAGE, 3, "image", "an image whose longer side is twice the lens radius")

#define CLSHEAR_EMITTERS_LIST(X)                                           \
    X(TREE, 0, "tree", "by their light at the point, then by solid angle") \
    X(POWER, 1, "power", "by power, then by area; none that a texture varies")

#define CLSHEAR_TONE_LIST(X)                                                  \
    X(SRGB, 0, "srgb", "the sRGB curve alone; values are cut at 1")           \
    X(FILMIC, 1, "filmic", "Hable's curve first, which rolls highlights off") \
    X(AGX, 2, "agx", "Sobotka's AgX first, which also takes the colour out of them")

#define CLSHEAR_AOV_LIST(X)                                                          \
    X(ALBEDO, 0, "albedo", "Albedo.R/G/B: base colour of the surface that is seen")  \
    X(NORMAL, 1, "normal", "N.X/Y/Z: its unit shading normal, on the viewer's side") \
    X(POSITION, 2, "position", "P.X/Y/Z: its place, in the file's coordinates")      \
    X(DEPTH, 3, "depth", "Depth.Z: its camera depth")                                \
    X(COVERAGE, 4, "coverage", "Coverage.A: part of the samples that see a surface") \
    X(EMISSION, 5, "emission", "Emission.R/G/B: light that is seen directly")        \
    X(DIRECT, 6, "direct", "Direct.R/G/B: light that met one surface on its way")    \
    X(INDIRECT, 7, "indirect", "Indirect.R/G/B: light that met several")

/* ------------------------------------------------------------------------------------------------
 * Settings: X(identifier, number, name, aliases, kind, values, most, fallback, low, high, choices,
 *             use, argument, help)
 *
 * number    value of the enumerator; never reused, because compiled programs depend on it. It also
 *           gives the group in lists: 1 samples, 20 image, 40 camera, 50 lens, 60 light,
 *           70 scene file, 80 device, 90 stopping, 100 motion, 110 live view, and all numbers up to
 *           the next group
 * name      name of the flag, without dashes
 * aliases   other names of the flag, separated by spaces
 * kind      SWITCH (0 or 1), INTEGER, NUMBER, CHOICE (a name out of `choices`), TEXT
 * values    numbers in one value, separated by commas
 * most      largest number of values; above 1, each use of the flag appends one
 * fallback  default value; "": the render chooses it
 * low, high bounds of each number, both inclusive
 * choices   list of a CHOICE: shear, oracle, filter, aperture, sampler, emitters, tone, aov;
 *           otherwise none
 * use       RECIPE: affects the picture or its noise, is written to the metadata, and must be the
 *           same when a render is continued; RECORD: is written to the metadata; PRIVATE: neither
 * argument  placeholder in the help; "": the flag takes no value
 * help      one line, at most 53 characters
 * --------------------------------------------------------------------------------------------- */

/* clang-format off */
#define CLSHEAR_SETTING_LIST(X) \
    /* Samples */ \
    X(SPP, 1, "spp", "samples", INTEGER, 1, 1, "256", 1, 2e9, none, RECORD, "N", \
      "samples per pixel; the most where a rule may stop") \
    X(REPLICATES, 2, "replicates", "", INTEGER, 1, 1, "", 1, 2e9, none, RECIPE, "R", \
      "independent patterns of spp/R samples (2)") \
    X(SEED, 3, "seed", "", INTEGER, 1, 1, "0", 0, 4294967295.0, none, RECIPE, "N", \
      "another seed, another noise") \
    X(SAMPLER, 4, "sampler", "", CHOICE, 1, 1, "sz", 0, 0, sampler, RECIPE, "NAME", \
      "point set; sobol with light of a size or motion") \
    X(SHEAR, 5, "shear", "", CHOICE, 1, 1, "equal-area", 0, 0, shear, RECIPE, "KIND", \
      "equal-area, toroidal or none") \
    X(ORACLE, 6, "oracle", "", CHOICE, 1, 1, "edge", 0, 0, oracle, RECIPE, "RULE", \
      "edge, centre, median, near, far or pilot") \
    X(SHEAR_PX, 12, "shear-px", "", NUMBER, 1, 1, "", -1e6, 1e6, none, RECIPE, "S", \
      "shear by S pixels everywhere, not by the oracle") \
    X(LENS_RAYS, 7, "lens-rays", "", INTEGER, 1, 1, "16", 0, 256, none, RECIPE, "N", \
      "rays for the depths of a pixel") \
    X(ADAPTIVE, 8, "adaptive", "", SWITCH, 1, 1, "", 0, 1, none, RECORD, "", \
      "share samples out by need, --spp the mean; =0: evenly") \
    X(EXTENDABLE, 9, "extendable", "", SWITCH, 1, 1, "0", 0, 1, none, PRIVATE, "", \
      "keep the data for --extend in the EXR") \
    X(KEEP_PATTERNS, 10, "keep-patterns", "", SWITCH, 1, 1, "0", 0, 1, none, PRIVATE, "", \
      "keep the mean of each replicate: Pattern<n>.R/G/B") \
    X(FRESH_SETS, 16, "fresh-sets", "", SWITCH, 1, 1, "0", 0, 1, none, RECIPE, "", \
      "poisson, ccvt: sets of this seed, not the kept ones") \
    X(GAIN, 11, "gain-channel", "", SWITCH, 1, 1, "0", 0, 1, none, PRIVATE, "", \
      "measure the gain of the shear: channel Gain") \
    /* Image */ \
    X(WIDTH, 20, "width", "", INTEGER, 1, 1, "512", 1, 65536, none, RECIPE, "PX", \
      "image width") \
    X(HEIGHT, 21, "height", "", INTEGER, 1, 1, "512", 1, 65536, none, RECIPE, "PX", \
      "image height") \
    X(CROP, 22, "crop", "", INTEGER, 4, 1, "", 0, 65536, none, PRIVATE, "X0,X1,Y0,Y1", \
      "render these pixels only, X0 <= x < X1, Y0 <= y < Y1") \
    X(FILTER, 23, "filter", "", CHOICE, 1, 1, "box", 0, 0, filter, RECIPE, "KIND", \
      "box, tent, gaussian or blackman-harris") \
    X(FILTER_WIDTH, 24, "filter-width", "", NUMBER, 1, 1, "", 0.01, 64, none, RECIPE, "PX", \
      "the filter's whole width (box 1, tent 2, others 3)") \
    X(EXPOSURE, 25, "exposure", "", NUMBER, 1, 1, "0", -100, 100, none, RECORD, "EV", \
      "brighter by EV stops; not in EXR files") \
    X(AUTO_EXPOSURE, 26, "auto-exposure", "", SWITCH, 1, 1, "0", 0, 1, none, RECORD, "", \
      "the picture's log-average grey first; not in EXR") \
    X(TONE, 27, "tone", "", CHOICE, 1, 1, "srgb", 0, 0, tone, RECORD, "CURVE", \
      "srgb, filmic or agx; not in EXR files") \
    X(AOV, 30, "aov", "", CHOICE, 1, 8, "", 0, 0, aov, RECORD, "NAME,...", \
      "more channels in the EXR: albedo, normal, depth...") \
    /* Camera */ \
    X(EYE, 40, "eye", "", NUMBER, 3, 1, "", -1e12, 1e12, none, RECIPE, "X,Y,Z", \
      "camera position") \
    X(TARGET, 41, "target", "", NUMBER, 3, 1, "", -1e12, 1e12, none, RECIPE, "X,Y,Z", \
      "the point that the camera looks at") \
    X(UP, 42, "up", "", NUMBER, 3, 1, "", -1e12, 1e12, none, RECIPE, "X,Y,Z", \
      "the direction that is up in the picture") \
    X(FOV, 43, "fov", "", NUMBER, 1, 1, "", 1e-3, 179.999, none, RECIPE, "DEG", \
      "field of view along the shorter image axis") \
    X(FOCAL_DISTANCE, 44, "focal-distance", "focus-distance", NUMBER, 1, 1, "", 1e-12, 1e12, none, \
      RECIPE, "D", "depth of the plane in focus") \
    X(FOCUS_PIXEL, 45, "focus-pixel", "", INTEGER, 2, 1, "", 0, 65535, none, PRIVATE, "X,Y", \
      "focus on the depth at this pixel") \
    X(CAMERA, 46, "camera", "", TEXT, 1, 1, "", 0, 0, none, PRIVATE, "NAME|N", \
      "the file's camera of that name or number from 0") \
    X(ORBIT, 47, "orbit", "", NUMBER, 2, 1, "", -360, 360, none, PRIVATE, "AZIMUTH,ELEVATION", \
      "frame the scene from there, degrees; 0,0: its front") \
    X(FOCUS_POINT, 48, "focus-point", "", NUMBER, 3, 1, "", -1e12, 1e12, none, PRIVATE, "X,Y,Z", \
      "focus on the depth of this point") \
    X(ORTHOGRAPHIC, 49, "orthographic", "", NUMBER, 1, 1, "", 0, 1e12, none, RECIPE, "WIDTH", \
      "parallel view, WIDTH along the shorter axis; 0: fits") \
    /* Lens */ \
    X(LENS_RADIUS, 50, "lens-radius", "aperture-radius", NUMBER, 1, 1, "", 0, 1e12, none, RECIPE, \
      "R", "lens radius in scene units; 0: pinhole") \
    X(F_STOP, 51, "fstop", "", NUMBER, 1, 1, "", 1e-6, 1e6, none, PRIVATE, "N", \
      "lens radius as f-number of a full-frame camera") \
    X(UNIT, 52, "unit", "", NUMBER, 1, 1, "1", 1e-12, 1e12, none, PRIVATE, "METRES", \
      "length of a scene unit, for --fstop") \
    X(APERTURE, 53, "aperture", "", CHOICE, 1, 1, "disk", 0, 0, aperture, RECIPE, "SHAPE", \
      "disk, square, polygon or an image file") \
    X(BLADES, 54, "blades", "", INTEGER, 1, 1, "6", 3, 32, none, RECIPE, "N", \
      "a polygon with N corners") \
    X(BLADE_ROTATION, 55, "blade-rotation", "", NUMBER, 1, 1, "0", -1e6, 1e6, none, RECIPE, "DEG", \
      "turn the polygon; at 0 a corner is on the right") \
    X(ANAMORPHIC, 56, "anamorphic", "", NUMBER, 1, 1, "1", 0.01, 100, none, RECIPE, "RATIO", \
      "aperture narrower by this ratio") \
    X(BLUR, 57, "blur", "", NUMBER, 1, 1, "", 0, 1e6, none, PRIVATE, "PX", \
      "lens radius by the blur of points at infinity") \
    X(TILT, 58, "tilt", "", NUMBER, 2, 1, "0,0", -89, 89, none, RECIPE, "AZIMUTH,ELEVATION", \
      "the focal plane faces there, degrees; 0,0: the camera") \
    /* Light */ \
    X(LIGHT, 60, "light", "", NUMBER, 6, 64, "", -1e15, 1e15, none, PRIVATE, "X,Y,Z,R,G,B", \
      "add a point light; repeatable") \
    X(SUN, 65, "sun", "", NUMBER, 7, 64, "", -1e15, 1e15, none, PRIVATE, "X,Y,Z,R,G,B,DEG", \
      "add a sun: towards it, irradiance, size; repeatable") \
    X(SPHERE, 61, "sphere", "", NUMBER, 7, 64, "", -1e15, 1e15, none, PRIVATE, \
      "X,Y,Z,RADIUS,R,G,B", "add a ball of light, of this radiance; repeatable") \
    X(QUAD, 68, "quad", "", NUMBER, 12, 64, "", -1e15, 1e15, none, PRIVATE, \
      "C,C,C,U,U,U,V,V,V,R,G,B", "add a panel: corner, two edges; shines along U x V") \
    X(ENVIRONMENT, 62, "environment", "", TEXT, 1, 1, "", 0, 0, none, RECIPE, "FILE", \
      "lat-long image, R,G,B or gradient:ZENITH,HORIZON") \
    X(ENVIRONMENT_ROTATION, 63, "environment-rotation", "", NUMBER, 1, 1, "0", -1e6, 1e6, none, \
      RECIPE, "DEG", "turn about what is up, from above against the clock") \
    X(ENVIRONMENT_STRENGTH, 64, "environment-strength", "", NUMBER, 1, 1, "1", 0, 1e12, none, \
      RECIPE, "S", "its radiance is multiplied by this") \
    X(BOUNCES, 66, "bounces", "", INTEGER, 1, 1, "4", 0, 64, none, RECIPE, "N", \
      "surfaces that light meets on its way; 0: direct light") \
    X(EMITTERS, 69, "emitters", "", CHOICE, 1, 1, "tree", 0, 0, emitters, RECIPE, "CHOICE", \
      "how emissive triangles are sampled: tree or power") \
    X(CLAMP, 67, "clamp", "", NUMBER, 1, 1, "0", 0, 1e15, none, RECIPE, "L", \
      "most that a bounce adds to a sample (biased); 0: off") \
    /* Scene file */ \
    X(SMOOTH, 70, "smooth", "", NUMBER, 1, 1, "", 0, 180, none, PRIVATE, "DEG", \
      "smooth faces without normals that meet at less") \
    X(Z_UP, 71, "z-up", "", SWITCH, 1, 1, "", 0, 1, none, PRIVATE, "", \
      "+Z up, -Y in front, as in STL and 3DS; 0: +Y and +Z") \
    /* Device */ \
    X(DEVICE, 80, "device", "", TEXT, 1, 1, "", 0, 0, none, PRIVATE, "NAME", \
      "OpenCL device: number or part of its name") \
    X(THREADS, 81, "threads", "t nthreads", INTEGER, 1, 1, "0", 0, 4096, none, PRIVATE, "N", \
      "CPU threads; 0: all") \
    X(PACKET, 82, "packet", "", INTEGER, 1, 1, "", 1, 16, none, PRIVATE, "W", \
      "samples traced together: 1, 4, 8 or 16") \
    X(RECORD, 83, "record", "", TEXT, 1, 1, "", 0, 0, none, PRIVATE, "FILE", \
      "capsule of the launches, for tools/replay.c") \
    X(FORCE, 84, "force", "", SWITCH, 1, 1, "0", 0, 1, none, PRIVATE, "", \
      "use a device that fails its test") \
    /* Stopping */ \
    X(NOISE, 90, "noise", "", NUMBER, 1, 1, "", 1e-6, 1, none, RECORD, "R", \
      "stop when the picture's relative error is below R") \
    X(NOISE_PIXEL, 91, "noise-pixel", "", NUMBER, 1, 1, "", 1e-6, 1, none, RECORD, "R", \
      "stop when 95 % of pixels err less on a screen") \
    X(TIME, 92, "time", "", NUMBER, 1, 1, "", 0.001, 1e9, none, RECORD, "S", \
      "stop after S seconds") \
    X(CHECKPOINT, 93, "checkpoint", "", TEXT, 1, 1, "", 0, 0, none, PRIVATE, "FILE", \
      "keep what is rendered there, for --resume") \
    X(EVERY, 94, "every", "", NUMBER, 1, 1, "60", 0, 1e9, none, PRIVATE, "S", \
      "seconds between two checkpoints, or previews") \
    X(RESUME, 95, "resume", "", SWITCH, 1, 1, "0", 0, 1, none, PRIVATE, "", \
      "go on from the checkpoint, if there is one") \
    X(SHARD, 96, "shard", "", TEXT, 1, 1, "", 0, 0, none, RECORD, "K/N", \
      "part K of N: every Nth replicate, for clshear merge") \
    /* Motion */ \
    X(CAMERA_TO, 100, "camera-to", "", NUMBER, 6, 1, "", -1e12, 1e12, none, RECIPE, "EYE,TARGET", \
      "where the camera is when the shutter closes") \
    X(TO, 101, "to", "", TEXT, 1, 1, "", 0, 0, none, RECIPE, "FILE", \
      "the same mesh where the shutter closes") \
    X(TURNTABLE, 102, "turntable", "", NUMBER, 1, 1, "", -90, 90, none, RECIPE, "DEG", \
      "the scene turns by DEG while the shutter is open") \
    X(SHUTTER, 103, "shutter", "", NUMBER, 2, 1, "", -1e6, 1e6, none, RECIPE, "OPEN,CLOSE", \
      "seconds of the animation, from the frame's time on") \
    X(SHUTTER_ANGLE, 104, "shutter-angle", "", NUMBER, 1, 1, "180", 0, 360, none, RECIPE, "DEG", \
      "part of a frame, without --shutter; 360: all of it") \
    X(FRAME, 105, "frame", "", INTEGER, 1, 1, "", 0, 1e6, none, RECIPE, "N", \
      "frame of the animation, from 0") \
    X(FPS, 106, "fps", "", NUMBER, 1, 1, "24", 1e-3, 1e6, none, RECIPE, "N", \
      "frames per second of the animation") \
    X(SHUTTER_RAMPS, 107, "shutter-ramps", "", NUMBER, 2, 1, "0,0", 0, 1, none, RECIPE, \
      "OPENING,CLOSING", "parts of the shutter's time that it opens and closes") \
    /* Live view */ \
    X(DISPLAY, 110, "display", "", TEXT, 1, 1, "", 0, 0, none, PRIVATE, "HOST:PORT", \
      "send it as it grows to a viewer there: tev, HDRView") \
    X(PREVIEW, 111, "preview", "", TEXT, 1, 1, "", 0, 0, none, PRIVATE, "FILE", \
      "write the picture so far there, as often as --every")
/* clang-format on */

#endif
