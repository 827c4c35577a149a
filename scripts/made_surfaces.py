#!/usr/bin/env python3
"""Made recordings of surfaces that are not copper, for scripts/surfaces_results.sh.

  made_surfaces.py FOLDER

150 frames of 128 x 96 each, 8 bit, lossless: a plate of 88 x 68 pixels with a grain of 5 % on a gray
backdrop (encoded 0.35) or on black (0.02), under noise of 0.6 % of full scale unless said otherwise. Not simulated:
no physics, only what changes look like. Same numbers on every machine with the same numpy. Needs
python3-numpy and ffmpeg (Debian).
"""
import pathlib
import subprocess
import sys

import numpy as np

WIDTH, HEIGHT, FRAMES = 128, 96, 150
Y, X = np.mgrid[0:HEIGHT, 0:WIDTH]
PLATE = (abs(X - 64) < 44) & (abs(Y - 48) < 34)
TAU = 2 * np.pi


def pattern(reach, random):
    """Noise that reaches as far, in pixels; mean 0, deviation 1."""
    ky, kx = np.fft.fftfreq(HEIGHT)[:, None], np.fft.fftfreq(WIDTH)[None]
    low = np.exp(-2 * (np.pi * reach) ** 2 * (kx**2 + ky**2))
    field = np.real(np.fft.ifft2(np.fft.fft2(random.normal(size=(HEIGHT, WIDTH))) * low))
    return (field - field.mean()) / field.std()


COARSE, FINE = (lambda r: (pattern(8, r), pattern(4, r)))(np.random.default_rng(5))


def blend(a, b, share):
    return np.array(a) + (np.array(b) - np.array(a)) * (share + 0 * COARSE)[..., None]


def soft(x):
    return 1 / (1 + np.exp(-x))


def blobs(u):
    places = ((40, 30, 60), (80, 60, 42), (60, 45, 24), (95, 35, 48))
    return np.max([soft((u * pace - np.hypot(X - x, Y - y)) / 2) for x, y, pace in places], axis=0)


COPPER, GREEN = (0.7, 0.45, 0.35), (0.4, 0.45, 0.4)

# name: (what it shows, color by (share of the recording, frame), and what is unusual about the camera)
SURFACES = {
    "dye": ("a dye that fades", lambda u, t: blend((0.7, 0.2, 0.25), (0.85, 0.75, 0.7),
            1 - np.exp(-(1.5 + 0.5 * COARSE) * u)), {}),
    "toast": ("bread that browns late", lambda u, t: blend((0.8, 0.7, 0.5), (0.3, 0.18, 0.1),
              soft(12 * (u - 0.5) + 1.5 * COARSE)), {}),
    "front": ("a front that sweeps across", lambda u, t: blend(COPPER, (0.25, 0.5, 0.4),
              soft((u * 140 - 10 - X + 3 * FINE) / 3)), {}),
    "drying": ("a wet patch that shrinks", lambda u, t: blend((0.3, 0.27, 0.22), (0.6, 0.55, 0.48),
               soft((np.hypot(X - 64, Y - 48) - 60 * (1 - u) + 3 * COARSE) / 2.5)), {}),
    "mold": ("blobs that grow outward", lambda u, t: blend((0.75, 0.7, 0.5), (0.2, 0.25, 0.2), blobs(u)), {}),
    "rust": ("rust that starts here, then there", lambda u, t: blend((0.5, 0.5, 0.52), (0.45, 0.2, 0.08),
             np.clip((u - 0.2 + 0.15 * COARSE + 0.05 * FINE) * 1.8, 0, 1)), {}),
    "pops": ("pixels that turn at once, each when it likes", lambda u, t: blend(COPPER, (0.2, 0.3, 0.25),
             1.0 * (COARSE + 1.5 * FINE < -3 + 5 * u)), {}),
    "hue": ("a color that goes around the circle", lambda u, t: np.stack(
            [0.5 + 0.3 * np.cos(TAU * (u * 1.2 + 0.05 * COARSE) + k * TAU / 3) for k in range(3)], -1), {}),
    "settling": ("a change that dies away", lambda u, t: blend((0.4, 0.3, 0.25), (0.7, 0.5, 0.35),
                 np.exp(-8 * u) * (1 + 0.2 * COARSE)), {}),
    "late": ("a change that gets ever faster", lambda u, t: blend(COPPER, (0.25, 0.45, 0.4),
             u**3 * (1 + 0.3 * COARSE)), {}),
    "slow": ("less than a code a unit", lambda u, t: blend((0.5, 0.4, 0.3), (0.53, 0.42, 0.31),
             u * (1 + 0.3 * COARSE)), {}),
    "clipping": ("brightens until it clips", lambda u, t: blend((0.5, 0.5, 0.5), (1.3, 1.2, 1.1),
                 u * (1 + 0.2 * COARSE)), {}),
    "stepping": ("still, but for two sudden steps", lambda u, t: blend((0.6, 0.4, 0.3), (0.4, 0.5, 0.45),
                 0.6 * (u > 0.35) + 0.4 * (u > 0.7)), {}),
    "wave": ("three slow swings", lambda u, t: blend((0.5, 0.4, 0.3), (0.7, 0.5, 0.4),
             0.5 + 0.5 * np.sin(3 * TAU * u + 0.5 * COARSE)), {}),
    "breath": ("swings of 12 frames on a slow drift, the exposure jitters by 1 %", lambda u, t: blend(
               (0.6, 0.4, 0.3), (0.5, 0.42, 0.36), 0.4 * u + 0.2 * np.sin(TAU * t / 12)), {"jitter": 0.01}),
    "daylight": ("the light swings by a quarter, four times", lambda u, t: blend(COPPER, (0.3, 0.45, 0.4),
                 u * (1 + 0.3 * COARSE)), {"light": lambda u: 1 + 0.25 * np.sin(4 * TAU * u)}),
    "noisy": ("noise of 8 %", lambda u, t: blend(COPPER, (0.5, 0.45, 0.4), u * (1 + 0.3 * COARSE)),
              {"noise": 0.08}),
    "shaking": ("the camera shakes by a pixel", lambda u, t: blend(COPPER, GREEN, u * (1 + 0.3 * COARSE)),
                {"shake": 1}),
    "coarse": ("25 levels in all", lambda u, t: blend(COPPER, (0.6, 0.45, 0.4), u * (1 + 0.3 * COARSE)),
               {"levels": 24}),
}
ON_BLACK = ("front", "hue", "noisy")

WALK = np.cumsum(np.random.default_rng(3).normal(size=(FRAMES, 3)) * 0.01, axis=0)
EVEN = 1 + 0.3 * COARSE

# Drawn up after the method had been changed for the first: nothing was changed for these.
SECOND = {
    "stopping": ("a change that stops half-way", lambda u, t: blend(COPPER, GREEN, 1.6 * min(u, 0.5) * EVEN), {}),
    "turning": ("and one that goes back", lambda u, t: blend(COPPER, GREEN, 2 * min(u, 1 - u) * EVEN), {}),
    "explosive": ("grows exponentially", lambda u, t: blend(COPPER, (0.1, 0.4, 0.35),
                  np.expm1(4 * u) / 54 * EVEN), {}),
    "two-paced": ("half of it starts half-way", lambda u, t: blend(COPPER, GREEN,
                  np.where(COARSE > 0, u, np.clip(2 * u - 1, 0, 1))), {}),
    "speeding": ("twenty times as fast from 60 % on", lambda u, t: blend(COPPER, GREEN,
                 0.1 * u + max(0, 2 * (u - 0.6))), {}),
    "local-swing": ("swings of 13 frames, here before there", lambda u, t: blend(COPPER, GREEN,
                    0.5 + 0.3 * np.sin(TAU * t / 13 + 2 * COARSE)), {}),
    "ripple": ("a wave of 30 pixels that travels", lambda u, t: blend(COPPER, GREEN,
               0.5 + 0.4 * np.sin(TAU * (X / 30 - t / 20))), {}),
    "square": ("to and fro by steps, on a drift", lambda u, t: blend(COPPER, GREEN,
               0.3 * u + 0.2 * (t // 9 % 2)), {}),
    "sawtooth": ("rises for 22 frames and falls back, over and over", lambda u, t: blend((0.6, 0.5, 0.4),
                 (0.4, 0.35, 0.3), t % 22 / 22 * (1 + 0.2 * COARSE)), {}),
    "walk": ("a color that walks at random", lambda u, t:
             np.array((0.5, 0.45, 0.4)) + WALK[t] + 0.05 * COARSE[..., None], {}),
    "blinking": ("a spot that blinks", lambda u, t: np.where(
                 (((X - 64) ** 2 + (Y - 48) ** 2 < 60) & (t % 5 == 0))[..., None], 0.95,
                 blend(COPPER, GREEN, u * EVEN)), {}),
    "passing": ("a dark bar passes in front", lambda u, t: np.where((abs(X - t + 20) < 8)[..., None], 0.15,
                blend(COPPER, GREEN, u * EVEN)), {}),
    "glints": ("highlights that move about", lambda u, t: np.clip(blend(COPPER, GREEN, u * EVEN)
               + 0.5 * soft((FINE - 1.5 + 0.8 * np.sin(0.9 * t)) * 6)[..., None], 0, 1), {}),
    "exposure": ("the camera changes its exposure three times", lambda u, t: blend(COPPER, GREEN, u * EVEN),
                 {"light": lambda u: 1 if u < 0.3 else 1.25 if u < 0.55 else 0.9 if u < 0.8 else 1.1}),
    "balance": ("the white balance drifts by 20 %", lambda u, t: blend(COPPER, GREEN, 0.3 * u * EVEN)
                * np.array((1 + 0.1 * u, 1, 1 - 0.1 * u)), {}),
}
SECOND_ON_BLACK = ("sawtooth", "walk", "exposure", "balance")


def aging(u, t):
    return blend((0.6, 0.45, 0.35), (0.5, 0.45, 0.38), 0.5 * u * EVEN)


def reflections():
    random, clouds = np.random.default_rng(9), []
    for t in range(FRAMES):
        new = pattern(14, random)
        clouds.append(new if t == 0 else 0.9 * clouds[-1] + np.sqrt(1 - 0.81) * new)
    return clouds


CLOUDS = reflections()

# What somebody found who set out to break it: light that the plate shares with its backdrop in part or not at
# all, for which the method was changed then; and two more ways to go to and fro, for which it was not.
THIRD = {
    "dusk-behind": ("the wall behind dims once, the plate has a lamp", aging,
                    {"behind": lambda u, t: 0.15 + 0.85 * soft((75 - t) / 12)}),
    "window-behind": ("the wall's light wanders by 30 %, the plate's does not", aging,
                      {"behind": lambda u, t: np.exp(0.2 * (np.sin(3.1 * TAU * u) + np.sin(5.3 * TAU * u + 1)))}),
    "nearer-lamp": ("swings of 10 % on the plate are 15 % on the wall", aging,
                    {"light": lambda u: 1 + 0.1 * np.sin(2 * TAU * u),
                     "behind": lambda u, t: (1 + 0.15 * np.sin(2 * TAU * u)) / (1 + 0.1 * np.sin(2 * TAU * u))}),
    "table-dries": ("the table under the plate dries", aging,
                    {"behind": lambda u, t: 0.55 + 0.45 * soft((u - 0.4) * 12)}),
    "somebody-behind": ("somebody walks by behind, every twelve frames", aging,
                        {"behind": lambda u, t: np.where(abs(X - t % 12 * 28) < 45, 0.05, 1)}),
    "clouds": ("reflections come and go within ten frames", lambda u, t: blend(
               (0.5, 0.4, 0.35), (0.42, 0.42, 0.38), u * EVEN) + 0.05 * CLOUDS[t][..., None], {}),
    "watered": ("watered every 30 frames, dries in between", lambda u, t: blend(
                (0.6, 0.5, 0.4), (0.4, 0.33, 0.26), np.exp(-(t % 30) / 8) * EVEN), {}),
}


def shifted(image, dx, blur):
    """Seen through a lens that blurs by so many pixels, moved to the right by `dx`."""
    ky, kx = np.fft.fftfreq(HEIGHT)[:, None, None], np.fft.fftfreq(WIDTH)[None, :, None]
    turn = np.exp(-2 * (np.pi * blur) ** 2 * (kx**2 + ky**2) - 1j * TAU * kx * dx)
    return np.real(np.fft.ifft2(np.fft.fft2(image, axes=(0, 1)) * turn, axes=(0, 1)))


SPOTS = [(r.uniform(25, 103), r.uniform(18, 78), r.uniform(0.05, 0.8))
         for r in (np.random.default_rng(900 + i) for i in range(25))]
FLAMES = np.random.default_rng(77).normal(size=FRAMES)
DUST = np.random.default_rng(78).random((HEIGHT, WIDTH)) > 0.5


def ripe(u):
    """Round spots, each of which begins at its own time."""
    inside = [soft((18 * (u - begins) - np.hypot(X - x, Y - y)) / 0.7) * (u > begins) for x, y, begins in SPOTS]
    return np.max(inside, axis=0)


# And a fourth after the third, of what happens to real cameras and other things that people film; nothing was changed for it.
FOURTH = {
    "creeping": ("still, the camera creeps by 0.02 pixels a frame", lambda u, t: blend(COPPER, COPPER, 0),
                 {"seen_as": lambda lit, u, t: shifted(lit, 0.02 * t, 0.8)}),
    "creeping-aging": ("aging, by 0.03 pixels", aging, {"seen_as": lambda lit, u, t: shifted(lit, 0.03 * t, 0.8)}),
    "focus": ("aging, the focus breathes", aging,
              {"seen_as": lambda lit, u, t: shifted(lit, 0, 1.1 + 0.5 * np.sin(t / 9))}),
    "balance-hunts": ("aging, the white balance swings by 6 %", aging,
                      {"seen_as": lambda lit, u, t: lit * (1 + 0.06 * np.sin(t / 4) * np.array([1, 0, -1]))}),
    "fog": ("breath on the metal: it fogs and clears every 44 frames", lambda u, t: blend(
            COPPER, (0.75, 0.75, 0.75), 0.35 * np.clip(np.sin(t / 7) * EVEN, 0, 1)), {}),
    "interference": ("colors of a film that grows, and then rings of them", lambda u, t: np.stack(
                     [0.45 + 0.25 * np.cos((2 + 15 * u * EVEN) * k) for k in (1, 1.2, 1.45)], -1), {}),
    "shadow": ("aging, a soft shadow crosses every 64 frames", aging,
               {"seen_as": lambda lit, u, t:
                lit * (1 - 0.35 * np.exp(-(((X - (4 * t % 256 - 64)) / 40) ** 2)))[..., None]}),
    "candle": ("aging by candlelight, which flickers by 8 %", aging,
               {"seen_as": lambda lit, u, t: lit * (1 + 0.08 * FLAMES[t] * np.array([1, 0.9, 0.8]))}),
    "warm-sensor": ("still, the sensor warms up and adds a little everywhere", lambda u, t: blend(COPPER, COPPER, 0),
                    {"seen_as": lambda lit, u, t: lit + 0.03 * (1 - np.exp(-t / 25))}),
    "ripening": ("dark spots begin here and there, and grow", lambda u, t: blend(
                 (0.8, 0.65, 0.3), (0.3, 0.2, 0.1), ripe(u)), {}),
    "in-patches": ("patches change and stop, each at its own time", lambda u, t: blend(
                   COPPER, (0.35, 0.5, 0.42), 0.6 * np.minimum(1, 2.5 * u * np.exp(0.6 * COARSE))), {}),
    "dust": ("dust settles, grain by grain", lambda u, t: blend(COPPER, (0.6, 0.6, 0.58), 0.6 * u * DUST), {}),
}


def record(path, color, seed, noise=0.006, light=lambda u: 1, jitter=0, shake=0, levels=255, backdrop=0.35,
           behind=lambda u, t: 1, seen_as=lambda lit, u, t: lit):
    random = np.random.default_rng(seed)
    grain = 1 + 0.05 * pattern(1.5, random)
    out = subprocess.Popen(
        ["ffmpeg", "-nostdin", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s",
         f"{WIDTH}x{HEIGHT}", "-r", "10", "-i", "-", "-c:v", "ffv1", "-pix_fmt", "bgr0", "-fflags", "+bitexact", path],
        stdin=subprocess.PIPE)
    for t in range(FRAMES):
        u = t / (FRAMES - 1)
        picture = np.where(PLATE[..., None], color(u, t) * grain[..., None], backdrop)
        lit = np.clip(picture, 0, 1) ** 2.2 * light(u) * (1 + jitter * random.normal())
        lit *= np.where(PLATE, 1, behind(u, t))[..., None]
        seen = np.clip(seen_as(lit, u, t), 0, 1) ** (1 / 2.2)
        if shake:
            seen = np.roll(seen, tuple(random.integers(-shake, shake + 1, size=2)), axis=(0, 1))
        seen = np.round((seen + noise * random.normal(size=seen.shape)) * levels) / levels
        out.stdin.write((np.clip(seen, 0, 1) * 255 + 0.5).astype(np.uint8).tobytes())
    out.stdin.close()
    if out.wait() != 0:
        sys.exit(f"{path}: ffmpeg failed")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for surfaces, on_black, first, jitter in ((SURFACES, ON_BLACK, 100, 0.01), (SECOND, SECOND_ON_BLACK, 300, 0),
                                             (THIRD, (), 500, 0), (FOURTH, (), 700, 0)):
        for seed, (name, (what, color, camera)) in enumerate(surfaces.items(), first):
            record(folder / f"{name}.mkv", color, seed, **camera)
            print(f"{name}\t{what}")
            if name in on_black:
                dark = {**camera, "jitter": jitter, "backdrop": 0.02}
                record(folder / f"{name}-on-black.mkv", color, first + 100, **dark)
                print(f"{name}-on-black\tthe same on black" + (", the exposure jitters by 1 %" if jitter else ""))


if __name__ == "__main__":
    main()
