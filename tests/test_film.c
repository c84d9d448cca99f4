/* Written pictures and their metadata, as read by oiiotool. */
#include "support.h"

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "clshear/device/hash.h"
#include "film/film.h"

static cs_error error;

static clshear_film *make_film(void)
{
    const int window[4] = {2, 5, 1, 3};
    clshear_film *film = NULL;
    assert_int_equal(cs_film_create(window, 8, 6, &error, &film), CLSHEAR_OK);
    const char *const names[] = {"R", "G", "B", "Variance.R", "Z"};
    for (int i = 0; i < 5; i++) {
        float *pixels = cs_film_add_channel(film, names[i]);
        for (int p = 0; p < 6; p++)
            pixels[p] = 0.1f * (float)p + (float)i;
    }
    return film;
}

/* The output of a command. */
static const char *output_of(const char *format, const char *path)
{
    static char text[16384];
    char command[2048];
    snprintf(command, sizeof command, format, path);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    text[fread(text, 1, sizeof text - 1, pipe)] = '\0';
    pclose(pipe);
    return text;
}

static int exists(const char *path)
{
    return access(path, F_OK) == 0;
}

static void exr_has_channels_windows_and_metadata(void **state)
{
    (void)state;
    clshear_film *film = make_film();
    const char *path = test_path("film.exr");
    const float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1};
    assert_int_equal(clshear_film_annotate(film, "Software", "first"), CLSHEAR_OK);
    assert_int_equal(clshear_film_annotate(film, "Software", "clshear test"), CLSHEAR_OK);
    assert_int_equal(cs_film_set_int(film, "samplesPerPixel", 42), CLSHEAR_OK);
    assert_int_equal(cs_film_set_float(film, "renderTimeSeconds", 1.5f), CLSHEAR_OK);
    assert_int_equal(cs_film_set_matrix(film, "worldtocamera", matrix), CLSHEAR_OK);
    assert_int_equal(clshear_film_write(film, path), CLSHEAR_OK);
    const char *text = output_of("oiiotool --info -v '%s'", path);
    assert_non_null(strstr(text, "3 x    2, 5 channel, float openexr"));
    assert_non_null(strstr(text, "channel list: R, G, B, Z, Variance.R"));
    assert_non_null(strstr(text, "pixel data origin: x=2, y=1"));
    assert_non_null(strstr(text, "full/display size: 8 x 6"));
    assert_non_null(strstr(text, "Software: \"clshear test\""));
    assert_non_null(strstr(text, "samplesPerPixel: 42"));
    assert_non_null(strstr(text, "renderTimeSeconds: 1.5"));
    assert_non_null(strstr(text, "worldToCamera: 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1"));
    clshear_film_free(film);
}

static void pictures_are_srgb(void **state)
{
    (void)state;
    const int window[4] = {0, 2, 0, 1};
    clshear_film *film = NULL;
    assert_int_equal(cs_film_create(window, 2, 1, &error, &film), CLSHEAR_OK);
    const char *const names[] = {"R", "G", "B"};
    for (int c = 0; c < 3; c++) {
        float *pixels = cs_film_add_channel(film, names[c]);
        pixels[0] = 0.2159f; /* sRGB 0.5020, 128 of 255 */
        pixels[1] = 7.0f;    /* above white */
    }
    const char *const files[] = {"film.png", "film.tif", "film.jpg"};
    for (int i = 0; i < 3; i++)
        assert_int_equal(clshear_film_write(film, test_path(files[i])), CLSHEAR_OK);
    const char *text = output_of("oiiotool --dumpdata '%s'", test_path("film.png"));
    assert_non_null(strstr(text, "Pixel (0, 0): 128 128 128"));
    assert_non_null(strstr(text, "Pixel (1, 0): 255 255 255"));
    clshear_film_free(film);
}

static void failures_leave_files_alone(void **state)
{
    (void)state;
    clshear_film *film = make_film();
    const char *kept = test_file("kept.xyz", "precious");
    assert_int_equal(clshear_film_write(film, kept), CLSHEAR_BAD_FILE);
    assert_non_null(strstr(clshear_film_message(film), "kept.xyz"));
    assert_string_equal(output_of("cat '%s'", kept), "precious");
    const char *nowhere = test_path("no/such/folder/a.exr");
    assert_int_equal(clshear_film_write(film, nowhere), CLSHEAR_BAD_FILE);
    assert_non_null(strstr(clshear_film_message(film), "a.exr"));
    assert_false(exists(nowhere));
    /* A folder has the final name: the file is written, but cannot be renamed. */
    const char *folder = test_path("folder.exr");
    mkdir(folder, 0777);
    assert_int_equal(clshear_film_write(film, folder), CLSHEAR_BAD_FILE);
    assert_string_equal(output_of("ls '%s'*.part* 2>/dev/null", folder), "");
    rmdir(folder);
    clshear_film_free(film);
}

static const char *const kinds[] = {"exr", "png", "jpg", "tif"};

/* Writes where something precious is, and files may have so many bytes: refused, without a trace.
 * The limit stands for a full disk. */
static void expect_no_room(clshear_film *film, const char *kept, rlim_t bytes)
{
    struct rlimit before;
    FILE *stream = fopen(kept, "w");
    fputs("precious", stream);
    fclose(stream);
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    setrlimit(RLIMIT_FSIZE, &(struct rlimit){bytes, before.rlim_max});
    const clshear_status status = clshear_film_write(film, kept);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(status, CLSHEAR_BAD_FILE);
    assert_non_null(strstr(clshear_film_message(film), kept));
    assert_non_null(strstr(clshear_film_message(film), ": cannot be written: File too large"));
    assert_string_equal(output_of("cat '%s'", kept), "precious");
    assert_string_equal(output_of("ls '%s'.part* 2>/dev/null", kept), "");
}

/* A large file of bytes says why it cannot be written, too. */
static void full_disks_have_their_reason(void **state)
{
    const size_t size = 1 << 20;
    char *bytes = calloc(size, 1);
    const char *kept = test_file("kept.npy", "precious");
    struct rlimit before;
    (void)state;
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    setrlimit(RLIMIT_FSIZE, &(struct rlimit){8192, before.rlim_max});
    const clshear_status status = clshear_file_write(kept, bytes, size);
    setrlimit(RLIMIT_FSIZE, &before);
    test_refused(status, CLSHEAR_BAD_FILE, "kept.npy: cannot be written: File too large");
    assert_string_equal(output_of("cat '%s'", kept), "precious");
    assert_string_equal(output_of("ls '%s'.part* 2>/dev/null", kept), "");
    free(bytes);
}

/* In the middle, where libjpeg would end the process, and in the last bytes, of which OpenEXR and
 * libtiff do not tell. */
static void full_disks_are_noticed(void **state)
{
    const int window[4] = {0, 300, 0, 200};
    clshear_film *film = NULL;
    struct stat whole;
    (void)state;
    assert_int_equal(cs_film_create(window, 300, 200, &error, &film), CLSHEAR_OK);
    for (int c = 0; c < 3; c++) {
        float *pixels = cs_film_add_channel(film, (const char[]){"RGB"[c], '\0'});
        for (int p = 0; p < 300 * 200; p++)
            pixels[p] = (float)(cs_hash((cs_u32)(3 * p + c)) >> 8) * 0x1p-24f;
    }
    for (int i = 0; i < 4; i++) {
        char name[16];
        snprintf(name, sizeof name, "kept.%s", kinds[i]);
        const char *kept = test_path(name);
        test_ok(clshear_film_write(film, kept));
        assert_int_equal(stat(kept, &whole), 0);
        const rlim_t size = (rlim_t)whole.st_size;
        const rlim_t limits[] = {0, 8192, size - 5000, size - 300, size - 1};
        for (size_t k = 0; k < sizeof limits / sizeof *limits; k++)
            expect_no_room(film, kept, limits[k]);
        remove(kept);
    }
    clshear_film_free(film);
}

static void *count_bytes(void *argument)
{
    FILE *stream = fopen(argument, "rb");
    static size_t count;
    count = 0;
    while (stream != NULL && fgetc(stream) != EOF)
        count++;
    if (stream != NULL) fclose(stream);
    return &count;
}

/* Writes into a pipe, which stays one. */
static void expect_pipe_stays(clshear_film *film, const char *kind)
{
    char path[1024], name[16];
    pthread_t reader;
    void *count;
    struct stat about;
    snprintf(name, sizeof name, "pipe.%s", kind);
    snprintf(path, sizeof path, "%s", test_path(name));
    remove(path);
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_int_equal(pthread_create(&reader, NULL, count_bytes, path), 0);
    assert_int_equal(clshear_film_write(film, path), CLSHEAR_OK);
    pthread_join(reader, &count);
    assert_above(*(size_t *)count, 100);
    assert_int_equal(stat(path, &about), 0);
    assert_true(S_ISFIFO(about.st_mode));
    remove(path);
}

/* Writes through a link, which stays one. */
static void expect_link_stays(clshear_film *film, const char *kind)
{
    char path[1024], file[1024], name[16];
    struct stat about;
    snprintf(name, sizeof name, "link.%s", kind);
    snprintf(path, sizeof path, "%s", test_path(name));
    snprintf(name, sizeof name, "real.%s", kind);
    snprintf(file, sizeof file, "%s", test_path(name));
    fclose(fopen(file, "w"));
    remove(path);
    assert_int_equal(symlink(file, path), 0);
    assert_int_equal(clshear_film_write(film, path), CLSHEAR_OK);
    assert_int_equal(lstat(path, &about), 0);
    assert_true(S_ISLNK(about.st_mode));
    assert_int_equal(stat(file, &about), 0);
    assert_above(about.st_size, 100);
    remove(path);
    remove(file);
}

/* Pipes are written in place, and a link still leads to its file. TIFF needs to be read while it is
 * written: devices and pipes are refused, where it was broken without a word. */
static void pipes_and_links_stay(void **state)
{
    clshear_film *film = make_film();
    (void)state;
    for (int i = 0; i < 4; i++) {
        if (strcmp(kinds[i], "tif") != 0) expect_pipe_stays(film, kinds[i]);
        expect_link_stays(film, kinds[i]);
    }
    const char *device = test_path("device.tif");
    remove(device);
    assert_int_equal(symlink("/dev/null", device), 0);
    test_refused(clshear_film_write(film, device), CLSHEAR_BAD_FILE,
                 "device.tif: TIFF goes into files only; write PNG or EXR there");
    remove(device);
    clshear_film_free(film);
}

/* Sixteen stored patterns and the gain have more than 64 channels. */
static void no_channel_is_lost(void **state)
{
    clshear_film *film = make_film(), *read = NULL;
    const char *path = test_path("many.exr");
    char name[32];
    (void)state;
    for (int i = 0; i < 136; i++) {
        snprintf(name, sizeof name, "Pattern%d.R", i);
        float *pixels = cs_film_add_channel(film, name);
        for (int p = 0; p < 6; p++)
            pixels[p] = (float)(6 * i + p);
    }
    assert_int_equal(clshear_film_write(film, path), CLSHEAR_OK);
    assert_int_equal(cs_film_read(path, &error, &read), CLSHEAR_OK);
    for (int i = 0; i < 136; i++) {
        snprintf(name, sizeof name, "Pattern%d.R", i);
        assert_memory_equal(clshear_film_channel(read, name), clshear_film_channel(film, name),
                            6 * sizeof(float));
    }
    clshear_film_free(read);
    clshear_film_free(film);
    remove(path);
}

/* A film that is read knows whether it is complete, its samples and its time. */
static void films_recall_their_render(void **state)
{
    static const struct {
        const char *shards;
        int interrupted;
        int complete;
    } cases[] = {{NULL, 0, 1},    {NULL, 1, 0},    {"3/7", 0, 1},    {"3/7", 1, 0},
                 {"1-3/7", 0, 0}, {"1-7/7", 0, 1}, {"damaged", 0, 0}};
    const char *path = test_path("recalled.exr");
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        clshear_film *film = make_film(), *read = NULL;
        float *samples = cs_film_add_channel(film, "Samples");
        for (int p = 0; p < 6; p++)
            samples[p] = (float)(16 + p);
        test_ok(cs_film_set_float(film, "renderTimeSeconds", 1.5f));
        if (cases[i].interrupted) test_ok(cs_film_set_int(film, "clshear.interrupted", 1));
        if (cases[i].shards != NULL)
            test_ok(clshear_film_annotate(film, "clshear.shard", cases[i].shards));
        test_ok(clshear_film_write(film, path));
        test_ok(clshear_film_read(path, &read));
        const clshear_film_info info = test_film_info(read);
        assert_int_equal(info.complete, cases[i].complete);
        assert_int_equal(info.samples, 6 * 16 + 15);
        assert_true(info.render_s == 1.5);
        assert_memory_equal(info.window, ((const int[4]){2, 5, 1, 3}), sizeof info.window);
        assert_int_equal(info.full_width, 8);
        assert_int_equal(info.full_height, 6);
        clshear_film_free(read);
        clshear_film_free(film);
    }
}

/* Every line of text that is taken comes back from the file; the others are refused. */
/* Other formats are no films, even where their name says EXR. */
static void films_are_exr(void **state)
{
    clshear_film *film = NULL;
    (void)state;
    assert_int_equal(clshear_film_read(test_file("picture.exr", "P3\n1 1\n255\n1 2 3\n"), &film),
                     CLSHEAR_BAD_FILE);
    assert_non_null(strstr(clshear_message(), "picture.exr: is no EXR file"));
    assert_null(film);
}

static void texts_come_back_or_are_refused(void **state)
{
    static const char *const good[] = {"Software", "DateTime", "Copyright",    "name",
                                       "view",     "a b",      "clshear.note", "ImageDescription",
                                       "hash"};
    static const char *const bad[] = {
        "channels", "dataWindow",    "screenWindowWidth", "compression", "tiles",    "type",
        "owner",    "worldtocamera", "PixelAspectRatio",  "png:text",    "oiio:text"};
    const char *path = test_path("texts.exr");
    char name[49];
    clshear_film *film = make_film(), *read = NULL;
    (void)state;
    memset(name, 'n', 48);
    name[48] = '\0';
    test_refused(clshear_film_annotate(film, name, "a text"), CLSHEAR_BAD_ARGUMENT,
                 "48 bytes; it must have 1 to 47");
    test_refused(clshear_film_annotate(film, "", "a text"), CLSHEAR_BAD_ARGUMENT, "0 bytes");
    name[47] = '\0';
    test_ok(clshear_film_annotate(film, name, "a text"));
    test_ok(cs_film_set_int(film, "samplesPerPixel", 4));
    test_refused(clshear_film_annotate(film, "samplesPerPixel", "5"), CLSHEAR_BAD_ARGUMENT,
                 "is a number of the film");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        test_refused(clshear_film_annotate(film, bad[i], "a text"), CLSHEAR_BAD_ARGUMENT,
                     "keeps this name for itself");
    test_refused(clshear_film_annotate(film, "SamplesPerPixel", "5"), CLSHEAR_BAD_ARGUMENT,
                 "is a number of the film");
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        test_ok(clshear_film_annotate(film, good[i], "a text"));
    test_refused(clshear_film_annotate(film, "NAME", "a text"), CLSHEAR_BAD_ARGUMENT,
                 "files do not tell this name from name");
    test_refused(clshear_film_annotate(film, "datetime", "a text"), CLSHEAR_BAD_ARGUMENT,
                 "files do not tell this name from DateTime");
    test_ok(clshear_film_write(film, path));
    test_ok(clshear_film_read(path, &read));
    assert_string_equal(clshear_film_text(read, name), "a text");
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        assert_string_equal(clshear_film_text(read, good[i]), "a text");
    size_t count = 0;
    for (const char *each; (each = clshear_film_text_name(read, count)) != NULL; count++)
        assert_non_null(clshear_film_text(read, each));
    assert_at_least(count, 1 + sizeof good / sizeof *good);
    assert_null(clshear_film_text(read, "samplesPerPixel"));
    assert_null(clshear_film_text(NULL, "Software"));
    assert_null(clshear_film_text_name(NULL, 0));
    clshear_film_free(read);
    clshear_film_free(film);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exr_has_channels_windows_and_metadata),
        cmocka_unit_test(pictures_are_srgb),
        cmocka_unit_test(failures_leave_files_alone),
        cmocka_unit_test(full_disks_are_noticed),
        cmocka_unit_test(full_disks_have_their_reason),
        cmocka_unit_test(pipes_and_links_stay),
        cmocka_unit_test(no_channel_is_lost),
        cmocka_unit_test(films_recall_their_render),
        cmocka_unit_test(films_are_exr),
        cmocka_unit_test(texts_come_back_or_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
