/* Emissive triangles: their solid angles, the directions in them, and the tree that chooses one. */
#include "support.h"

#include <math.h>

#include "clshear/device/hash.h"
#include "kernels/light/emitter_tree.h"
#include "scene/emitters.h"

static const double pi = 3.14159265358979;

/* Number `index` of stream `key`, in [0, 1). */
static float number_at(cs_u32 key, cs_u32 index)
{
    return (float)(cs_key(key, index) >> 8) * 0x1p-24f;
}

/* Van Oosterom & Strackee in double precision, from the origin. */
static double solid_angle(const double *a, const double *b, const double *c)
{
    const double *corners[3] = {a, b, c};
    double unit[3][3], sum = 1.0, triple = 0.0;
    for (int k = 0; k < 3; k++) {
        const double *v = corners[k];
        const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        for (int i = 0; i < 3; i++)
            unit[k][i] = v[i] / length;
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        for (int n = 0; n < 3; n++)
            sum += unit[i][n] * unit[j][n];
        triple += unit[0][i] * (unit[1][j] * unit[2][k] - unit[1][k] * unit[2][j]);
    }
    return 2.0 * atan2(fabs(triple), sum);
}

typedef struct triangle {
    const char *name;
    float corner[3];
    float edge1[3];
    float edge2[3];
    double error; /* of the solid angle, relative: what float32 leaves */
} triangle;

static const triangle triangles[] = {
    {"an octant", {1, 0, 0}, {-1, 1, 0}, {-1, 0, 1}, 1e-6},
    {"beside", {1, 2, 3}, {1, 0, 0.5f}, {0, 2, -1}, 2e-6},
    {"a close wall", {-3, -2, 0.01f}, {7, 1, 0}, {1, 9, 0}, 1e-6},
    {"almost all of a half", {-30, -20, 1e-4f}, {70, 10, 0}, {10, 90, 0}, 1e-6},
    {"a far speck", {1000, 400, 0}, {0, 0.01f, 0}, {0, 0, 0.01f}, 1e-5},
    {"a speck", {0, 0, 1e6f}, {1e-3f, 0, 0}, {0, 1e-3f, 0}, 1e-5},
    {"a sliver", {-1, 0, 1}, {2, 1e-4f, 0}, {2, 2e-4f, 0}, 1e-5},
    {"near its edge", {-0.01f, -1, 0.001f}, {0, 2, 0}, {-3, 1, 0}, 1e-5},
    {"seen aslant", {-1, 1, 1e-3f}, {2, 0, 0}, {1, 3, 0}, 1e-5}};

enum {
    TRIANGLES = sizeof triangles / sizeof *triangles,
    SIDE = 4 /* a triangle is divided into SIDE * SIDE */
};

/* The point at parts of the edges. */
static void point_of(const triangle *t, double b1, double b2, double *point)
{
    for (int i = 0; i < 3; i++)
        point[i] = (double)t->corner[i] + b1 * (double)t->edge1[i] + b2 * (double)t->edge2[i];
}

/* Solid angle of the triangle between three pairs of parts. */
static double part_of(const triangle *t, double a1, double a2, double b1, double b2, double c1,
                      double c2)
{
    double a[3], b[3], c[3];
    point_of(t, a1, a2, a);
    point_of(t, b1, b2, b);
    point_of(t, c1, c2, c);
    return solid_angle(a, b, c);
}

static void solid_angles(void **state)
{
    (void)state;
    for (int n = 0; n < TRIANGLES; n++) {
        const triangle *t = &triangles[n];
        const double truth = part_of(t, 0, 0, 1, 0, 0, 1);
        const cs_seen_triangle seen = cs_see_triangle(t->corner, t->edge1, t->edge2);
        print_message("%s: %.9g of %.9g\n", t->name, (double)seen.solid_angle, truth);
        assert_near(seen.solid_angle, truth, t->error * truth);
    }
    assert_near(
        cs_see_triangle(triangles[0].corner, triangles[0].edge1, triangles[0].edge2).solid_angle,
        pi / 2.0, 1e-6);
}

/* Which of the SIDE * SIDE equal parts holds a point. */
static int cell_of(float b1, float b2)
{
    const float x = b1 * SIDE, y = b2 * SIDE;
    int column = (int)x, row = (int)y;
    column = column < SIDE ? column : SIDE - 1;
    row = row < SIDE - column ? row : SIDE - 1 - column;
    const int upper = x - (float)column + y - (float)row > 1.0f && row < SIDE - 1 - column;
    int before = 0;
    for (int c = 0; c < column; c++)
        before += 2 * (SIDE - c) - 1;
    return before + 2 * row + upper;
}

static void expected_of_cells(const triangle *t, double *expected)
{
    int cell = 0;
    for (int column = 0; column < SIDE; column++)
        for (int row = 0; row < SIDE - column; row++) {
            const double x = (double)column / SIDE, y = (double)row / SIDE, s = 1.0 / SIDE;
            expected[cell++] = part_of(t, x, y, x + s, y, x, y + s);
            if (row < SIDE - 1 - column)
                expected[cell++] = part_of(t, x + s, y, x + s, y + s, x, y + s);
        }
}

/* Directions are uniform in the solid angle: counts in 16 parts of the triangle against their own
 * solid angles by chi-square, those that expect fewer than 10 of 40 000 independent draws together.
 * The limit is k + 5 sqrt(2 k) + 10: at 15 degrees of freedom a false alarm of 1e-6. Every point is
 * inside. */
static void directions_fill_the_solid_angle(void **state)
{
    enum {
        DRAWS = 40000
    };
    (void)state;
    for (int n = 0; n < TRIANGLES; n++) {
        const triangle *t = &triangles[n];
        double expected[SIDE * SIDE], seen_in[SIDE * SIDE] = {0};
        double total = 0.0, square = 0.0, rest = 0.0, rest_seen = 0.0;
        int cells = 0;
        const cs_seen_triangle seen = cs_see_triangle(t->corner, t->edge1, t->edge2);
        expected_of_cells(t, expected);
        for (int i = 0; i < SIDE * SIDE; i++)
            total += expected[i];
        assert_near(total, part_of(t, 0, 0, 1, 0, 0, 1), 1e-6 * total);
        for (cs_u32 i = 0; i < DRAWS; i++) {
            float place[2];
            const cs_pair pair = {number_at(1, i), number_at(2, i)};
            cs_draw_in_triangle(&seen, pair, place);
            assert_true(place[0] >= 0.0f && place[1] >= 0.0f && place[0] + place[1] <= 1.00001f);
            seen_in[cell_of(place[0], place[1])] += 1.0;
        }
        for (int i = 0; i < SIDE * SIDE; i++) {
            const double wanted = expected[i] / total * DRAWS, apart = seen_in[i] - wanted;
            if (wanted < 10.0) {
                rest += wanted;
                rest_seen += seen_in[i];
                continue;
            }
            square += apart * apart / wanted;
            cells++;
        }
        print_message("%s: chi-square %.1f in %d parts, %.0f of %.1f in the others\n", t->name,
                      square, cells, rest_seen, rest);
        assert_below(square, cells + 5.0 * sqrt(2.0 * cells) + 10.0);
        assert_below(rest_seen, rest + 6.0 * sqrt(rest + 1.0) + 3.0);
    }
}

enum {
    EMITTERS = 300
};

/* Triangles here and there, of all sizes and brightnesses. */
static void scatter(cs_array *table)
{
    cs_emitter *all = cs_array_extend(table, EMITTERS);
    for (cs_u32 i = 0; i < EMITTERS; i++) {
        const float size = expf(6.0f * number_at(3, i) - 5.0f);
        double e1[3], e2[3], square = 0.0;
        for (cs_u32 a = 0; a < 3; a++) {
            all[i].corner[a] = 10.0f * number_at(10 + a, i);
            e1[a] = (double)(all[i].edge1[a] = size * (number_at(20 + a, i) - 0.5f));
            e2[a] = (double)(all[i].edge2[a] = size * (number_at(30 + a, i) - 0.5f));
        }
        for (int a = 0; a < 3; a++) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            square += pow(e1[b] * e2[c] - e1[c] * e2[b], 2.0);
        }
        all[i].area = (float)(0.5 * sqrt(square));
        all[i].luminance = expf(4.0f * number_at(4, i));
    }
}

static cs_vantage vantage_at(cs_u32 n)
{
    cs_vantage vantage;
    double square = 0.0;
    for (cs_u32 a = 0; a < 3; a++) {
        vantage.point[a] = 14.0f * number_at(40 + a, n) - 2.0f;
        vantage.normal[a] = number_at(50 + a, n) - 0.5f;
        square += (double)(vantage.normal[a] * vantage.normal[a]);
    }
    for (int a = 0; a < 3; a++)
        vantage.normal[a] = (float)((double)vantage.normal[a] / sqrt(square));
    vantage.through = n % 4 == 0;
    return vantage;
}

static const cs_triangle_step at_rest[EMITTERS];

static cs_emitter_tree make_tree(cs_array *table, cs_array *nodes)
{
    cs_error error;
    table->item_size = sizeof(cs_emitter);
    scatter(table);
    assert_int_equal(cs_emitter_tree_build(NULL, table, nodes, &error), CLSHEAR_OK);
    assert_int_equal(nodes->count, 2 * EMITTERS);
    return (cs_emitter_tree){.nodes = nodes->items, .emitters = table->items, .steps = at_rest};
}

/* Numbers choose an emitter with the chance that is said, and what is left of them is spread
 * evenly: both within the width of two of the 4096 steps. All chances are 1 together, but for
 * choices that end where nothing shines, which say so. */
static void chances_are_what_is_chosen(void **state)
{
    enum {
        STEPS = 4096
    };
    cs_array table = {0}, nodes = {0};
    const cs_emitter_tree tree = make_tree(&table, &nodes);
    double ended = 0.0;
    (void)state;
    for (cs_u32 n = 0; n < 20; n++) {
        const cs_vantage vantage = vantage_at(n);
        double total = 0.0, none = 0.0, chances[EMITTERS], chosen[EMITTERS] = {0},
               rest[EMITTERS] = {0};
        for (int e = 0; e < EMITTERS; e++) {
            const cs_int_lanes index = {.all = e};
            total += chances[e] = (double)cs_emitter_chance(&tree, &vantage, index);
        }
        for (int i = 0; i < STEPS; i++) {
            const float number = ((float)i + 0.5f) / STEPS;
            const cs_emitter_choice choice = cs_choose_emitters(&tree, &vantage, number);
            const int e = choice.emitter.all;
            if (!(choice.probability > 0.0f)) {
                none += 1.0 / STEPS;
                continue;
            }
            assert_near(choice.probability, chances[e], 1e-5 * chances[e]);
            assert_true(choice.rest >= 0.0f && choice.rest <= 1.0f);
            chosen[e] += 1.0 / STEPS;
            rest[e] += (double)choice.rest / STEPS;
        }
        assert_near(total + none, 1.0, 40.0 / STEPS);
        ended += none / 20.0;
        for (int e = 0; e < EMITTERS; e++) {
            assert_near(chosen[e], chances[e], 2.0 / STEPS);
            assert_near(rest[e], 0.5 * chances[e], 2.0 / STEPS);
        }
    }
    print_message("%.3f of the choices end where nothing shines\n", ended);
    assert_below(ended, 0.2);
    cs_array_free(&table);
    cs_array_free(&nodes);
}

/* Light that an emitter gives to a point by a sum over 64 parts of it. */
static double light_of(const cs_emitter *emitter, const cs_vantage *vantage)
{
    double sum = 0.0;
    triangle t = {0};
    memcpy(t.edge1, emitter->edge1, sizeof t.edge1);
    memcpy(t.edge2, emitter->edge2, sizeof t.edge2);
    for (int i = 0; i < 3; i++)
        t.corner[i] = emitter->corner[i] - vantage->point[i];
    for (int k = 0; k < 64; k++) {
        const double root = sqrt((k / 8 + 0.5) / 8.0), b2 = root * (k % 8 + 0.5) / 8.0;
        double to[3];
        point_of(&t, root - b2, b2, to);
        double cosine = 0.0, length = 0.0;
        for (int i = 0; i < 3; i++) {
            cosine += to[i] * (double)vantage->normal[i];
            length += to[i] * to[i];
        }
        cosine = vantage->through ? fabs(cosine) : fmax(cosine, 0.0);
        sum += cosine / sqrt(length) / 64.0;
    }
    return sum * (double)emitter->luminance * part_of(&t, 0, 0, 1, 0, 0, 1);
}

/* Emitters that give light have a chance, but for what floats round off, and those that give much
 * have large ones: over 40 points the mean of squared light by chance, which is the variance of the
 * choice but for what all choices share, is at least four times less than with chances by power. */
static void the_tree_knows_what_gives_light(void **state)
{
    cs_array table = {0}, nodes = {0};
    const cs_emitter_tree tree = make_tree(&table, &nodes);
    const cs_emitter *all = table.items;
    double by_tree = 0.0, by_power = 0.0, power = 0.0;
    (void)state;
    for (int e = 0; e < EMITTERS; e++)
        power += (double)all[e].area * (double)all[e].luminance;
    for (cs_u32 n = 100; n < 140; n++) {
        const cs_vantage vantage = vantage_at(n);
        double sum = 0.0, lost = 0.0, square_tree = 0.0, square_power = 0.0;
        for (int e = 0; e < EMITTERS; e++) {
            const cs_int_lanes index = {.all = e};
            const double chance = (double)cs_emitter_chance(&tree, &vantage, index);
            const double light = light_of(&all[e], &vantage);
            sum += light;
            lost += chance > 0.0 ? 0.0 : light;
            if (chance > 0.0) square_tree += light * light / chance;
            square_power +=
                light * light * power / ((double)all[e].area * (double)all[e].luminance);
        }
        assert_at_most(lost, 1e-6 * sum);
        by_tree += (square_tree / (sum * sum) - 1.0) / 40.0;
        by_power += (square_power / (sum * sum) - 1.0) / 40.0;
    }
    print_message("relative variance of the choice: tree %.3f, power %.3f\n", by_tree, by_power);
    assert_below(4.0 * by_tree, by_power);
    cs_array_free(&table);
    cs_array_free(&nodes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solid_angles),
        cmocka_unit_test(directions_fill_the_solid_angle),
        cmocka_unit_test(chances_are_what_is_chosen),
        cmocka_unit_test(the_tree_knows_what_gives_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
