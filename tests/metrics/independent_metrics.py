#!/usr/bin/env python3
"""Holds `luciole compare` to programs that others wrote, and to FLIP derived a second time.

independent_metrics.py LUCIOLE: makes pictures, compares them with `LUCIOLE compare --json`, and checks PSNR and SSIM against
scikit-image, absolute and relative errors against OpenImageIO's idiff, and FLIP against the papers' formulas in numpy, with plain
two-dimensional convolutions. Ends with 77 if scikit-image or idiff is missing.
"""
import json
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
try:
    import numpy as np
    from skimage.io import imsave
    from skimage.metrics import peak_signal_noise_ratio, structural_similarity
except ImportError as error:
    print(f"skipped: {error}; install python3-skimage (scripts/packages.sh test)")
    sys.exit(SKIPPED)
if not shutil.which("idiff"):
    print("skipped: no idiff; install openimageio-tools (scripts/packages.sh test)")
    sys.exit(SKIPPED)


# Files

def write_exr(file, image):
    """The least that is an OpenEXR file ("OpenEXR File Layout"): floats, uncompressed, a line at a time."""
    height, width, _ = image.shape
    header = struct.pack("<ii", 20000630, 2)

    def attribute(name, kind, data):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data

    channels = b"".join(letter + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for letter in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header += attribute("channels", "chlist", channels) + attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
    header += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)) + attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    header += b"\0"
    lines = [struct.pack("<ii", y, 12 * width) + image[y, :, ::-1].T.astype("<f4").tobytes() for y in range(height)]
    first = len(header) + 8 * height
    offsets = struct.pack(f"<{height}Q", *(first + y * len(lines[0]) for y in range(height)))
    file.write_bytes(header + offsets + b"".join(lines))


def compare(luciole, reference, test, *options):
    run = subprocess.run([luciole, "compare", reference, test, "--json", *options], capture_output=True, text=True, check=False)
    if run.returncode not in (0, 1):
        sys.exit(f"compare {reference} {test}: {run.stderr}")
    return json.loads(run.stdout)


def idiff(reference, test):
    text = subprocess.run(["idiff", reference, test], capture_output=True, text=True, check=False).stdout
    return {name: float(re.search(rf"{name} error\s*=\s*(\S+)", text)[1]) for name in ("Mean", "RMS", "Max")}


# FLIP: Andersson et al. 2020 and 2021

RGB_TO_XYZ = np.array([[10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
                       [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
                       [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382]])
WHITE = RGB_TO_XYZ.sum(axis=1)
PIXELS_PER_DEGREE = 0.7 * 3840 / 0.7 * np.pi / 180


def convolve(plane, kernel):
    radius = kernel.shape[0] // 2
    padded = np.pad(plane, radius, mode="edge")
    result = np.zeros_like(plane)
    for (y, x), weight in np.ndenumerate(kernel):
        result += weight * padded[y:y + plane.shape[0], x:x + plane.shape[1]]
    return result


def grid(radius):
    return np.meshgrid(np.arange(-radius, radius + 1.0), np.arange(-radius, radius + 1.0))


def contrast_sensitivity(terms):
    x, y = grid(int(np.ceil(3 * np.sqrt(0.04 / (2 * np.pi**2)) * PIXELS_PER_DEGREE)))
    d2 = (x**2 + y**2) / PIXELS_PER_DEGREE**2
    kernel = sum(a * np.sqrt(np.pi / b) * np.exp(-np.pi**2 * d2 / b) for a, b in terms)
    return kernel / kernel.sum()


def hunt_lab(rgb):
    t = rgb @ RGB_TO_XYZ.T / WHITE
    f = np.where(t > (6 / 29)**3, np.cbrt(t), t / (3 * (6 / 29)**2) + 4 / 29)
    lightness = 116 * f[..., 1] - 16
    return np.stack([lightness, 0.01 * lightness * 500 * (f[..., 0] - f[..., 1]), 0.01 * lightness * 200 * (f[..., 1] - f[..., 2])], -1)


def hyab(a, b):
    return np.abs(a[..., 0] - b[..., 0]) + np.hypot(a[..., 1] - b[..., 1], a[..., 2] - b[..., 2])


def seen(rgb):
    x, y, z = np.moveaxis(rgb @ RGB_TO_XYZ.T / WHITE, -1, 0)
    luma = convolve(116 * y - 16, contrast_sensitivity([(1, 0.0047)]))
    red_green = convolve(500 * (x - y), contrast_sensitivity([(1, 0.0053)]))
    blue_yellow = convolve(200 * (y - z), contrast_sensitivity([(34.1, 0.04), (13.5, 0.025)]))
    y = (luma + 16) / 116
    xyz = np.stack([y + red_green / 500, y, y - blue_yellow / 200], -1) * WHITE
    return hunt_lab(np.clip(xyz @ np.linalg.inv(RGB_TO_XYZ).T, 0, 1))


def features(rgb, order):
    sigma = 0.5 * 0.082 * PIXELS_PER_DEGREE
    x, y = grid(int(np.ceil(3 * sigma)))
    kernel = np.exp(-(x**2 + y**2) / (2 * sigma**2)) * (-x if order == 1 else x**2 / sigma**2 - 1)
    kernel = np.where(kernel > 0, kernel / kernel[kernel > 0].sum(), kernel / -kernel[kernel < 0].sum())
    luminance = rgb @ RGB_TO_XYZ[1]
    return np.hypot(convolve(luminance, kernel), convolve(luminance, kernel.T))


def flip_of_linear(reference, test):
    largest = hyab(hunt_lab(np.array([0.0, 1, 0])), hunt_lab(np.array([0.0, 0, 1])))**0.7
    color = hyab(seen(reference), seen(test))**0.7
    color = np.where(color < 0.4 * largest, 0.95 / (0.4 * largest) * color, 0.95 + 0.05 * (color - 0.4 * largest) / (0.6 * largest))
    feature = np.maximum(*(np.abs(features(reference, order) - features(test, order)) for order in (1, 2)))
    return color**(1 - np.sqrt(feature / np.sqrt(2)))


def srgb_decoded(x):
    return np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055)**2.4)


def srgb_encoded(x):
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x**(1 / 2.4) - 0.055)


def hdr_flip(reference, test):
    k = [0.36 * 2.51, 0.6 * 0.03, 0, 0.36 * 2.43, 0.6 * 0.59, 0.14]
    b, c = ((k[1] - 0.85 * k[4]) / (k[0] - 0.85 * k[3]), (k[2] - 0.85 * k[5]) / (k[0] - 0.85 * k[3]))
    shown = -b / 2 + np.sqrt(b * b / 4 - c)
    luminance = np.sort((reference @ np.array([0.2126, 0.7152, 0.0722])).ravel())
    start, stop = np.log2(shown / luminance[-1]), np.log2(shown / luminance[(luminance.size - 1) // 2])

    def curve(x):
        return np.clip((k[0] * x * x + k[1] * x + k[2]) / (k[3] * x * x + k[4] * x + k[5]), 0, 1)

    exposures = np.linspace(start, stop, max(2, int(np.ceil(stop - start))))
    return np.max([flip_of_linear(curve(2**e * reference), curve(2**e * test)) for e in exposures], axis=0)


# The checks

failed = False


def check(what, found, expected, tolerance):
    global failed
    good = abs(found - expected) <= tolerance
    failed |= not good
    print(f"{'ok  ' if good else 'FAIL'}  {what}: luciole {found:.8g}, independent {expected:.8g}, tolerance {tolerance:.2g}")


def make_picture(height, width, rng):
    """Slopes, a disc with a hard edge, a line and noise, in [0, 1]."""
    y, x = np.mgrid[0:height, 0:width] / max(height, width)
    image = np.stack([x, y, 1 - x * y], -1) * 0.8
    image[(x - 0.4)**2 + (y - 0.3)**2 < 0.04] = (0.9, 0.2, 0.1)
    image[height // 2, :] = (0.1, 0.9, 0.95)
    return np.clip(image + rng.normal(0, 0.02, image.shape), 0, 1)


def check_display_values(luciole, folder, rng):
    for name, (height, width), spread in (("fine", (47, 61), 0.01), ("coarse", (64, 40), 0.15), ("small", (11, 11), 0.05)):
        a = np.round(255 * make_picture(height, width, rng)).astype(np.uint8)
        b = np.round(255 * np.clip(a / 255 + rng.normal(0, spread, a.shape), 0, 1)).astype(np.uint8)
        b[5:9, 3:8] = (255, 255, 0)
        imsave(folder / "a.png", a, check_contrast=False)
        imsave(folder / "b.png", b, check_contrast=False)
        found = compare(luciole, folder / "a.png", folder / "b.png")
        x, y = a / 255, b / 255
        check(f"{name} PSNR", found["psnrDb"], peak_signal_noise_ratio(x, y, data_range=1), 1e-4)
        # luciole keeps planes as floats: 1e-7 of 1, against C2 = 9e-4.
        check(f"{name} SSIM", found["ssim"], structural_similarity(x, y, gaussian_weights=True, sigma=1.5, use_sample_covariance=False,
                                                                   data_range=1, channel_axis=2), 1e-5)
        error = flip_of_linear(srgb_decoded(x), srgb_decoded(y))
        check(f"{name} FLIP, mean", found["flipMean"], error.mean(), 1e-5)
        check(f"{name} FLIP, largest", found["flipMax"], error.max(), 1e-4)
        check(f"{name} RMS", 10**(-found["psnrDb"] / 20), idiff(folder / "a.png", folder / "b.png")["RMS"], 1e-5)


def check_radiance(luciole, folder, rng):
    a = (10 * make_picture(40, 52, rng)**3 + 1e-3).astype(np.float32)
    b = (a * rng.uniform(0.8, 1.25, a.shape)).astype(np.float32)
    write_exr(folder / "a.exr", a)
    write_exr(folder / "b.exr", b)
    for stops in (0, -3):
        found = compare(luciole, folder / "a.exr", folder / "b.exr", f"--exposure={stops}")
        x, y = (srgb_encoded(np.clip(image * 2.0**stops, 0, 1)) for image in (a.astype(float), b.astype(float)))
        check(f"radiance PSNR at {stops} stops", found["psnrDb"], peak_signal_noise_ratio(x, y, data_range=1), 1e-3)
        check(f"radiance SSIM at {stops} stops", found["ssim"], structural_similarity(x, y, gaussian_weights=True, sigma=1.5,
                                                                                      use_sample_covariance=False, data_range=1, channel_axis=2), 1e-5)
    error = hdr_flip(a.astype(float), b.astype(float))
    check("radiance FLIP, mean", found["flipMean"], error.mean(), 1e-5)
    check("radiance FLIP, largest", found["flipMax"], error.max(), 1e-4)
    relative = (np.abs(b.astype(float) - a) / (a + 0.01 * a.astype(float).mean())).max(axis=2)
    check("radiance, largest relative error in %", found["maxErrorPercent"], 100 * relative.max(), 1e-4)
    check("radiance, mean relative error in %", found["meanErrorPercent"], 100 * relative.mean(), 1e-4)


def check_errors_by_idiff(luciole, folder, rng):
    """On an even reference c the relative error is the absolute one over 1.01 c; of grey noise no channel is the worst."""
    c = 0.25
    a = np.full((31, 45, 3), c, np.float32)
    b = (a + rng.normal(0, 0.05, (31, 45, 1))).astype(np.float32)
    write_exr(folder / "a.exr", a)
    write_exr(folder / "b.exr", b)
    found, errors = compare(luciole, folder / "a.exr", folder / "b.exr"), idiff(folder / "a.exr", folder / "b.exr")
    # idiff prints six digits.
    check("largest error in %", found["maxErrorPercent"], 100 * errors["Max"] / (1.01 * c), 1e-3)
    check("mean error in %", found["meanErrorPercent"], 100 * errors["Mean"] / (1.01 * c), 1e-3)


def main():
    luciole = sys.argv[1]
    rng = np.random.default_rng(2020)
    with tempfile.TemporaryDirectory() as name:
        check_display_values(luciole, Path(name), rng)
        check_radiance(luciole, Path(name), rng)
        check_errors_by_idiff(luciole, Path(name), rng)
    sys.exit(1 if failed else 0)


main()
