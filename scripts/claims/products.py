"""Pictures of the product of spectra: why two pixels converge as they do."""
import math
import subprocess

from measure import clshear, pixels_of

SCENE = 'scenes/cornell.obj --quiet'
SIDE = 128      # frequencies along a side
DECADES = 8.0   # from white to black, as `clshear slice --spectrum` has it
# Pixel, the oracle's shear there in pixels.
CASES = [('146,330', -4.745), ('242,488', 0.006)]


def brightness(values, decades=DECADES):
    """Logarithms as grey from 0 to 255, the largest value white."""
    top = max(values.values())
    return {place: 0 if v <= 0.0 else max(0, round(255 * (1 + math.log10(v / top) / decades)))
            for place, v in values.items()}


def write(path, grey):
    """A picture as PNG, by way of a portable grey map."""
    plain = path.with_suffix('.pgm')
    plain.write_bytes(f'P5 {SIDE} {SIDE} 255\n'.encode()
                      + bytes(grey[x, y] for y in range(SIDE) for x in range(SIDE)))
    subprocess.run(['oiiotool', str(plain), '-o', str(path)], check=True)


def first_channel(path):
    return {place: v[0] for place, v in pixels_of(path).items()}


def panels(pixel, shear, work):
    """Energy of the integrand in XU; power of multi-jittered pairs and the product, without and with the shear."""
    energy_file = work / f'energy-{pixel}.exr'
    clshear(f'slice {SCENE} --pixel {pixel} --projection xu --resolution {SIDE} --no-line '
            f'--out {work}/slice.exr --spectrum {energy_file}')
    energy = first_channel(energy_file)
    top = max(energy.values())
    yield 'energy', brightness(energy)
    for name, given in [('none', 0.0), ('sheared', shear)]:
        power_file = work / f'power-{pixel}-{name}.exr'
        clshear(f'spectrum --sampler mj --n 256 --projection xu --sets 400 --resolution {SIDE} '
                f'--shear-px={given} --out {power_file}')
        power = first_channel(power_file)
        yield f'power-{name}', {place: min(255, round(128 * v)) for place, v in power.items()}
        product = {place: power[place] * v for place, v in energy.items()}
        product['top'] = top  # the same scale as the energy's
        yield f'product-{name}', brightness(product)


def pictures(folder, work, mosaic):
    names = []
    for pixel, shear in CASES:
        for name, grey in panels(pixel, shear, work):
            names.append(work / f'{pixel}-{name}.png')
            write(names[-1], grey)
    mosaic([str(n) for n in names], '5x2', folder / 'products.png', ['--resize:filter=box', '1312x528'])
