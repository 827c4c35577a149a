#!/usr/bin/env python3
"""The four networks in PyTorch's Python API, for the time of a training step beside ours.

  networks_torch.py [--threads 2] [--steps 6] [--size 128] [--batch 4] [NETWORK ...]

Prints one line per network: parameters, seconds per step (median), peak memory. The same layers,
loss, augmentation, gradient limit and optimizer as verdigris/learn (docs/models/learn.md); data are
random, which costs the same. Needs python3-torch (Debian).
"""
import argparse
import math
import resource
import statistics
import time

import torch
import torch.nn.functional as F
from torch import nn

N, K = 5, 10


def conv(i, o, k, stride=1):
    return nn.Conv2d(i, o, k, stride=stride, padding=k // 2)


def norm(c):
    return nn.GroupNorm(8, c)


def up(x):
    return F.interpolate(x, scale_factor=2, mode="bilinear", align_corners=False)


def median(frames):
    s = frames.sort(1)[0]
    n = s.shape[1]
    return s[:, n // 2] if n % 2 else 0.5 * (s[:, n // 2 - 1] + s[:, n // 2])


class Cell(nn.Module):
    def __init__(self, i, h=80):
        super().__init__()
        self.gates = conv(i + h, 4 * h, 3)

    def forward(self, x, h, c):
        i, f, g, o = self.gates(h if x is None else torch.cat([x, h], 1)).chunk(4, 1)
        c = torch.sigmoid(f + 1) * c + torch.sigmoid(i) * torch.tanh(g)
        return torch.sigmoid(o) * torch.tanh(c), c


class ConvLstm(nn.Module):
    def __init__(self, size):
        super().__init__()
        self.e1, self.e2, self.f2, self.f1 = Cell(48), Cell(80), Cell(0), Cell(80)
        self.h1, self.h2 = conv(160, 88, 3), conv(88, 48, 1)
        nn.init.zeros_(self.h2.weight), nn.init.zeros_(self.h2.bias)

    def forward(self, context, units):
        p = F.pixel_unshuffle(context, 4)
        z = torch.zeros(p.shape[0], 80, *p.shape[-2:])
        h1 = c1 = h2 = c2 = z
        for i in range(context.shape[1]):
            h1, c1 = self.e1(p[:, i], h1, c1)
            h2, c2 = self.e2(h1, h2, c2)
        out = []
        for _ in units:
            h2, c2 = self.f2(None, h2, c2)
            h1, c1 = self.f1(h2, h1, c1)
            d = self.h2(F.silu(self.h1(torch.cat([h1, h2], 1))))
            out.append(context[:, -1] + 0.1 * F.pixel_shuffle(d, 4))
        return torch.stack(out, 1)


class Unit(nn.Module):
    def __init__(self, d=128, m=512):
        super().__init__()
        self.n1, self.n2, self.n3 = nn.LayerNorm(d), nn.LayerNorm(d), nn.LayerNorm(d)
        self.qkv, self.out = nn.Linear(d, 3 * d, bias=False), nn.Linear(d, d)
        self.gate, self.value, self.down = nn.Linear(d, m), nn.Linear(d, m), nn.Linear(m, d)

    def forward(self, x):
        s, n, d = x.shape
        q, k, v = self.qkv(self.n1(x)).view(s, n, 3, 4, d // 4).permute(2, 0, 3, 1, 4)
        w = torch.softmax(torch.matmul(q / math.sqrt(d // 4), k.transpose(-2, -1)), -1)
        x = x + self.out(torch.matmul(w, v).transpose(1, 2).reshape(s, n, d))
        y = self.n2(x)
        return self.n3(x + self.down(F.silu(self.gate(y)) * self.value(y)))


class PredFormer(nn.Module):
    def __init__(self, size):
        super().__init__()
        self.embed, self.norm, self.head = nn.Linear(192, 128), nn.LayerNorm(128), nn.Linear(128, 192)
        self.space = nn.Parameter(0.02 * torch.randn((size // 8) ** 2, 128))
        self.time = nn.Parameter(0.02 * torch.randn(N, 128))
        self.units = nn.ModuleList(Unit() for _ in range(6))
        nn.init.zeros_(self.head.weight), nn.init.zeros_(self.head.bias)

    def chunk(self, frames):
        b, n, _, h, w = frames.shape
        p = F.pixel_unshuffle(frames, 8).flatten(3).transpose(2, 3)
        c = p.shape[2]
        x = self.embed(p) + self.space + self.time[:, None]
        for i in range(0, 6, 2):
            x = self.units[i](x.transpose(1, 2).reshape(b * c, n, 128))
            x = self.units[i + 1](x.view(b, c, n, 128).transpose(1, 2).reshape(b * n, c, 128))
            x = x.view(b, n, c, 128)
        d = self.head(self.norm(x)).transpose(2, 3).reshape(b, n, 192, h // 8, w // 8)
        return frames[:, -1:] + 0.1 * F.pixel_shuffle(d, 8)

    def forward(self, context, units):
        first = self.chunk(context)
        return torch.cat([first, self.chunk(first)], 1)


class Block(nn.Module):
    def __init__(self, i, o, stride=1):
        super().__init__()
        self.conv, self.norm = conv(i, o, 3, stride), norm(o)

    def forward(self, x):
        return F.silu(self.norm(self.conv(x)))


class Film(nn.Module):
    def __init__(self, i, o):
        super().__init__()
        self.conv, self.norm, self.film = conv(i, o, 3), norm(o), nn.Linear(128, 2 * o)

    def forward(self, x, e):
        g, b = self.film(e)[:, :, None, None].chunk(2, 1)
        return self.norm(self.conv(x)) * (1 + g) + b


class HorizonNet(nn.Module):
    def __init__(self, size):
        super().__init__()
        self.c0, self.d1, self.c1 = Block(3 * N, 32), Block(32, 64, 2), Block(64, 64)
        self.d2, self.c2 = Block(64, 128, 2), Block(128, 128)
        self.e1, self.e2 = nn.Linear(128, 256), nn.Linear(256, 128)
        self.m1, self.m2, self.u1, self.u0 = Film(128, 128), Film(128, 128), Film(192, 64), Film(96, 32)
        self.u1b, self.u0b, self.out = Block(64, 64), Block(32, 32), conv(32, 3, 3)
        nn.init.zeros_(self.out.weight), nn.init.zeros_(self.out.bias)

    def forward(self, context, units):
        b, h = context.shape[0], len(units)
        full = self.c0(context.flatten(1, 2))
        half = self.c1(self.d1(full))
        quarter = self.c2(self.d2(half))
        phase = torch.tensor(units, dtype=torch.float32)[:, None] * 1000.0 ** (-torch.arange(64) / 64)
        e = self.e2(F.silu(self.e1(torch.cat([phase.sin(), phase.cos()], 1)))).repeat(b, 1)
        each = lambda x: x.repeat_interleave(h, 0)
        x = each(quarter)
        x = x + F.silu(self.m2(F.silu(self.m1(x, e)), e))
        x = self.u1b(F.silu(self.u1(torch.cat([up(x), each(half)], 1), e)))
        x = self.u0b(F.silu(self.u0(torch.cat([up(x), each(full)], 1), e)))
        return context[:, -1:] + 0.1 * self.out(x).view(b, h, 3, *context.shape[-2:])


class PatinaNet(nn.Module):
    def __init__(self, size):
        super().__init__()
        self.a0, self.a1, self.a2, self.a3 = Block(18, 24), Block(24, 48, 2), Block(48, 64, 2), Block(64, 64)
        self.y1, self.y0 = Block(112, 48), Block(72, 24)
        self.rho, self.state, self.features = conv(24, 1, 1), conv(24, 1, 1), conv(24, 8, 1)
        self.globals, self.p1, self.p2 = nn.Linear(79, 64), nn.Linear(65, 32), nn.Linear(32, 1)
        self.g1, self.g2, self.g3 = conv(20, 128, 1), conv(128, 128, 1), conv(128, 3, 1)
        self.d = nn.Parameter(torch.zeros(()))

    def forward(self, context, units):
        canvas = median(context)
        change = 10 * (context - canvas[:, None]).flatten(1, 2)
        x0 = self.a0(torch.cat([canvas, change], 1))
        x1 = self.a1(x0)
        x2 = self.a3(self.a2(x1))
        y = self.y0(torch.cat([up(self.y1(torch.cat([up(x2), x1], 1))), x0], 1))
        rho, s = torch.sigmoid(self.rho(y)), torch.sigmoid(self.state(y) - 2)
        f = torch.tanh(self.features(y))
        z = F.silu(self.globals(torch.cat([x2.mean((2, 3)), change.mean((2, 3))], 1)))
        fixed = torch.cat([canvas, f], 1)

        def decode(s):
            waves = [s] + [g(math.pi * j * s) for j in range(1, 5) for g in (torch.sin, torch.cos)]
            return self.g3(F.silu(self.g2(F.silu(self.g1(torch.cat([fixed] + waves, 1))))))

        now, out, spread = decode(s), [], 0.25 * torch.sigmoid(self.d)
        for _ in units:
            pace = F.softplus(self.p2(F.silu(self.p1(torch.cat([z, s.mean((2, 3))], 1)))) - 4)
            delta = rho * (1 - s) * pace[:, :, None, None]
            p = F.pad(delta, (1, 1, 1, 1), mode="replicate")
            near = p[..., :-2, 1:-1] + p[..., 2:, 1:-1] + p[..., 1:-1, :-2] + p[..., 1:-1, 2:]
            s = s + torch.minimum(F.relu((1 - 4 * spread) * delta + spread * near), 1 - s)
            out.append(context[:, -1] + 0.1 * (decode(s) - now))
        return torch.stack(out, 1)


NETWORKS = {"patinanet": PatinaNet, "convlstm": ConvLstm, "predformer": PredFormer, "horizonnet": HorizonNet}


def augmented(windows):
    out = []
    for w in windows:
        theta = torch.tensor([[[0.9, 0, 0.02], [0, 0.9, 0.01]]])
        folded = w.flatten(0, 1)[None]
        grid = F.affine_grid(theta, folded.shape, align_corners=False)
        moved = F.grid_sample(folded, grid, mode="bilinear", padding_mode="reflection", align_corners=False)
        out.append(moved.view_as(w) * 1.01 + 0.01)
    return torch.stack(out)


def step(model, optimizer, windows, units):
    windows = augmented(windows)
    with torch.no_grad():
        change = (windows[:, N:] - median(windows[:, :N])[:, None]).abs().mean(2, True).amax(1, True)
        mask = (change > 0.004).float()
    truth = windows[:, [N + k - 1 for k in units]]
    optimizer.zero_grad()
    squared = (model(windows[:, :N], units) - truth).pow(2).mean(2, True)
    foreground = (squared * mask).sum((2, 3, 4)) / mask.sum((1, 2, 3, 4)).clamp_min(1)[:, None]
    loss = foreground.mean() + 0.1 * squared.mean()
    loss.item()
    loss.backward()
    nn.utils.clip_grad_norm_(model.parameters(), 1.0)
    optimizer.step()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("networks", nargs="*", default=list(NETWORKS))
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--steps", type=int, default=6)
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--batch", type=int, default=4)
    a = parser.parse_args()
    torch.set_num_threads(a.threads)
    for name in a.networks:
        torch.manual_seed(0)
        model = NETWORKS[name](a.size)
        optimizer = torch.optim.AdamW(model.parameters(), lr=2e-4)
        windows = torch.rand(a.batch, N + K, 3, a.size, a.size)
        units = [2, 5, 9] if name == "horizonnet" else list(range(1, K + 1))
        times = []
        for _ in range(a.steps + 1):
            start = time.perf_counter()
            step(model, optimizer, windows, units)
            times.append(time.perf_counter() - start)
        parameters = sum(p.numel() for p in model.parameters())
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
        print(f"{name} {parameters} {statistics.median(times[1:]):.3f} s/step, peak {memory:.2f} GB", flush=True)


if __name__ == "__main__":
    main()
