"""The scenes that both renderers have."""
from lights import directional, environment, panel, point, sphere, spot, sun
from shapes import ball, card, ground, lamp
from surfaces import (black_coat, black_dielectric, diffuse, foil, glass, shining, textured,
                      tinted_metal, white_metal)


def scenes(folder):
    """Name: parts (geometry, surface), lights, bounces."""
    grey, sky = (ground(), diffuse(0.5, 0.4, 0.3)), environment(folder)
    uneven = environment(folder, 60.0)
    lit = point([2.0, 4.0, 1.0], [30.0, 25.0, 20.0])
    solid = [grey, (ball(), diffuse(0.8, 0.2, 0.4))]

    def with_ball(of):
        return [grey, (ball(), of)]

    return {
        "point": (solid, [lit], 0),
        "spot": (solid, [spot([0.5, 4.0, 0.5], [30.0, 25.0, 20.0], 40.0)], 0),
        "directional": (solid, [directional([0.6, 0.8, 0.0], [3.0, 2.0, 1.0])], 1),
        "sun": (solid, [sun([0.6, 0.8, 0.0], [3.0, 2.0, 1.0], 20.0)], 1),
        "area": ([*solid, (lamp(), shining(8.0, 6.0, 4.0))], [], 1),
        "sphere": (solid, [sphere([1.2, 1.8, 1.5], 0.4, [12.0, 9.0, 6.0])], 1),
        "panel": (solid, [panel([-1.0, 3.0, -1.0], [2.0, 0.5, 0.0], [0.0, 0.0, 2.0],
                                [8.0, 6.0, 4.0])], 1),
        "environment": (solid, [sky], 1),
        "environment-uneven": (solid, [uneven], 1),
        "four-bounces": ([*solid, (card(2.2, 2.0), diffuse(0.9, 0.9, 0.9))],
                         [point([2.0, 0.4, 1.5], [8.0, 8.0, 8.0])], 4),
        "metal-polished": (with_ball(white_metal(0.25)), [sky], 2),
        "metal-rough": (with_ball(white_metal(0.7)), [sky, lit], 2),
        "metal-tinted": (with_ball(tinted_metal(0.5, 0.9, 0.5, 0.2)), [sky, lit], 2),
        "metal-uneven": (with_ball(white_metal(0.4)), [uneven], 2),
        "dielectric-facets": (with_ball(black_dielectric(0.4)), [sky, lit], 2),
        "coat-facets": (with_ball(black_coat(0.3)), [sky, lit], 2),
        "glass-smooth": (with_ball(glass(0.0)), [sky], 12),
        "glass-rough": (with_ball(glass(0.5)), [sky], 12),
        "glass-uneven": (with_ball(glass(0.5)), [uneven], 6),
        "foil": ([grey, (card(), foil(0.9, 0.5, 0.2))], [sky], 8),
        "foil-uneven": ([grey, (card(), foil(0.9, 0.5, 0.2))], [uneven], 4),
        "alpha": ([grey, (card(), textured(open_texels=True))], [sky], 8),
        "texture-transform": ([(ground(2.0), textured(([2.5, 1.5], [0.3, 0.1])))], [lit], 0),
    }


def showcase(folder):
    """Facets of metal under an environment, four bounces: name, parts, lights, bounces."""
    grey, sky = (ground(), diffuse(0.5, 0.4, 0.3)), environment(folder)
    lit = point([2.0, 4.0, 1.0], [30.0, 25.0, 20.0])
    metals = [white_metal(0.2), tinted_metal(0.5, 0.9, 0.5, 0.2), white_metal(0.7)]
    row = [(ball(0.55, [1.3 * (i % 3 - 1), 0.6, 1.2 * (i // 3 - 1)], 5), metals[i % 3])
           for i in range(9)]
    return {
        "ball": ([grey, (ball(), white_metal(0.4))], [sky], 4),
        "many": ([grey, *row], [sky, lit], 4),
        "shelter": ([(ground(), white_metal(0.5)), (ball(cuts=5), diffuse(0.8, 0.2, 0.4)),
                     (card(2.2, 2.0), diffuse(0.9, 0.9, 0.9))], [sky], 4),
    }
