"""Surfaces as glTF's material and as Mitsuba's BSDF: the same formulas, (material, BSDF[, emitter])."""
import mitsuba as mi
import numpy as np


def rgb(colour):
    return {"type": "rgb", "value": list(colour)}


def two_sided(bsdf):
    return {"type": "twosided", "nested": bsdf}


def surface(colour, metallic=0.0, roughness=1.0, **extensions):
    return {"pbrMetallicRoughness": {"baseColorFactor": [*colour, 1.0], "metallicFactor": metallic,
                                     "roughnessFactor": roughness},
            "extensions": {"KHR_materials_" + name: value for name, value in extensions.items()}}


def diffuse(*colour):
    return (surface(colour, specular={"specularFactor": 0.0}),
            two_sided({"type": "diffuse", "reflectance": rgb(colour)}))


def white_metal(roughness):
    return (surface((1, 1, 1), 1.0, roughness),
            two_sided({"type": "roughconductor", "distribution": "ggx", "material": "none",
                       "alpha": roughness ** 2}))


def tinted_metal(roughness, *colour):
    return (surface(colour, 1.0, roughness),
            two_sided({"type": "principled", "base_color": rgb(colour), "metallic": 1.0,
                       "roughness": roughness}))


def black_dielectric(roughness):
    """Its facets alone: Schlick's term from 0.04 to 1, as those of a metal of that colour."""
    _, twin = tinted_metal(roughness, 0.04, 0.04, 0.04)
    return surface((0, 0, 0), 0.0, roughness), twin


def black_coat(roughness):
    """A clear coat over black that reflects nothing."""
    _, twin = tinted_metal(roughness, 0.04, 0.04, 0.04)
    return (surface((0, 0, 0), specular={"specularFactor": 0.0},
                    clearcoat={"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": roughness}),
            twin)


def glass(roughness, index=1.5):
    twin = {"type": "dielectric", "int_ior": index, "ext_ior": 1.0}
    if roughness > 0.0:
        twin.update({"type": "roughdielectric", "distribution": "ggx", "alpha": roughness ** 2})
    return (surface((1, 1, 1), 0.0, roughness, ior={"ior": index},
                    transmission={"transmissionFactor": 1.0}, volume={"thicknessFactor": 1.0}),
            twin)


def foil(*colour):
    """A coloured wall without reflection."""
    return (surface(colour, 0.0, 0.0, specular={"specularFactor": 0.0},
                    transmission={"transmissionFactor": 1.0}),
            {"type": "thindielectric", "int_ior": 1.0, "ext_ior": 1.0,
             "specular_transmittance": rgb(colour)})


def shining(*radiance):
    """Its BSDF is black; Mitsuba's emitter is added where the triangles are."""
    material, twin = diffuse(0, 0, 0)
    material["emissiveFactor"] = [value / max(radiance) for value in radiance]
    material["extensions"]["KHR_materials_emissive_strength"] = {
        "emissiveStrength": max(radiance)}
    return material, twin, {"type": "area", "radiance": rgb(radiance)}


def checks():
    """8 x 8 texels of random colours that are all 0 or 255, which no curve changes; half of them
    are open."""
    texels = np.random.default_rng(5).integers(0, 2, (8, 8, 4)) * 255
    return texels.astype(np.uint8)


def textured(transform=None, open_texels=False):
    """Coloured by the texels, or black where their alpha is, which both interpolate and take as the
    chance of being there. Row 0 of both images is at coordinate 0 of v, though glTF's v grows
    down."""
    scale, offset = transform or ([1, 1], [0, 0])
    texels = checks()
    material, _ = diffuse(1, 1, 1)
    material["texels"] = texels
    material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0, "extensions": {
        "KHR_texture_transform": {"scale": scale, "offset": offset}}}
    values = texels.astype(np.float32) / 255.0

    def bitmap(data):
        frame = mi.ScalarTransform4f().translate([*offset, 0]).scale([*scale, 1])
        return {"type": "bitmap", "bitmap": mi.Bitmap(np.ascontiguousarray(data)), "raw": True,
                "filter_type": "bilinear", "wrap_mode": "repeat", "to_uv": frame}

    if not open_texels:
        material["alphaMode"] = "OPAQUE"
        return material, two_sided({"type": "diffuse", "reflectance": bitmap(values[:, :, :3])})
    material["alphaMode"] = "BLEND"
    material["pbrMetallicRoughness"]["baseColorFactor"] = [0, 0, 0, 1]
    return material, {"type": "mask", "opacity": bitmap(values[:, :, 3:]),
                      "nested": diffuse(0, 0, 0)[1]}
