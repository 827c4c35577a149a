#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The held-out protocol as one would write it in NumPy: persistence and the nine affine variants on
all windows, MSE over the foreground. The peer of bench/evaluate_bench.cpp (delta_e:0).

  EVALUATE_BENCH_SAMPLES=FOLDER verdigris_evaluate_bench --benchmark_filter=delta_e:0
  evaluate_numpy.py FOLDER/chamber.npy FOLDER/air.npy [--windows N]
"""
import argparse
import time

import numpy as np

STRIDE, CONTEXT, HORIZONS, TRIM, MIN_PIXELS = 10, 5, 10, 17, 64
SIGMA = 0.0012  # of the made recordings


def slopes(order):
    """Rows of the Vandermonde pseudo-inverse: weights of t and t^2."""
    vandermonde = np.vander(np.arange(CONTEXT), order + 1, increasing=True)
    return np.linalg.pinv(vandermonde)[1:]


def fit(x, v, family):
    """S, s with v ~ S x + s; x, v: (pixels, 3)."""
    mx, mv = x.mean(0), v.mean(0)
    if family == "single-gain":
        xc, vc = x - x.mean(), v - v.mean()
        gain = (vc * xc).sum() / (xc * xc).sum()
        return gain * np.eye(3), np.full(3, v.mean() - gain * x.mean())
    xc, vc = x - mx, v - mv
    if family == "per-channel":
        s = np.diag((vc * xc).sum(0) / (xc * xc).sum(0))
    else:
        s = np.linalg.solve(xc.T @ xc, xc.T @ vc).T
    return s, mv - s @ mx


def forecast(frames, family, order):
    """(HORIZONS, pixels, 3)."""
    last = frames[-1]
    out = np.repeat(last[None], HORIZONS, 0)
    for power, weights in enumerate(slopes(order), 1) if order else ():
        s, bias = fit(frames[0], np.tensordot(weights, frames, 1), family)
        rate = last @ s.T + bias
        k = np.arange(1, HORIZONS + 1)
        phi = (CONTEXT - 1 + k) ** power - (CONTEXT - 1) ** power
        out = out + phi[:, None, None] * rate
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("recordings", nargs="+")
    parser.add_argument("--windows", type=int, default=0, help="only the first N of each")
    args = parser.parse_args()
    variants = [("persistence", 0)] + [(f, o) for f in ("full", "per-channel", "single-gain")
                                       for o in (0, 1, 2)]
    tau = max(2.40 * SIGMA, 5e-4)
    windows, began = 0, time.perf_counter()
    for path in args.recordings:
        codes = np.load(path)
        samples = codes.reshape(len(codes), -1, 3)[TRIM:-TRIM] / np.float64(65535)
        starts = range(len(samples) - (CONTEXT + HORIZONS - 1) * STRIDE)
        errors = []
        for start in list(starts)[:args.windows or None]:
            window = samples[start:start + (CONTEXT + HORIZONS) * STRIDE:STRIDE]
            context, truth = window[:CONTEXT], window[CONTEXT:]
            change = np.abs(truth - np.median(context, 0)).mean(2).max(0)
            inside = change > tau
            if inside.sum() < MIN_PIXELS:
                continue
            row = []
            for family, order in variants:
                frames = forecast(context, family, order)
                row.append(((frames - truth)[:, inside] ** 2).mean((1, 2)))
            errors.append(row)
            windows += 1
        means = np.mean(errors, axis=(0, 2))
        print(path)
        for (family, order), mean in zip(variants, means):
            print(f"  {family} order {order}: {mean:.6e}  gain {100 * (1 - mean / means[0]):+.1f} %")
    seconds = time.perf_counter() - began
    print(f"{windows} windows in {seconds:.1f} s: {windows / seconds:.1f} windows/s")


if __name__ == "__main__":
    main()
