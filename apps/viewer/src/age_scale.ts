// SPDX-License-Identifier: MIT
// Where an age lies on the track, and back. Linear where that leaves the forecast room; else two
// straight pieces that meet at "now", because a long recording would squeeze the forecast, which
// is what the page is for, into a corner.

/** chosen: of the track's length, what the forecast gets at least. */
export const kForecastShare = 0.7;

export interface AgeScale {
  readonly first: number;    // units, <= 0
  readonly last: number;     // units, >= 0
  readonly now: number;      // share of the track left of age 0
  readonly broken: boolean;  // a unit is longer right of now than left of it
}

export function ageScale(first: number, last: number): AgeScale {
  const observed = Math.max(-first, 0), forecast = Math.max(last, 0), span = observed + forecast;
  const linear = span > 0 ? observed / span : 0;
  const broken = observed > 0 && forecast > 0 && 1 - linear < kForecastShare;
  return { first: -observed, last: forecast, now: broken ? 1 - kForecastShare : linear, broken };
}

/** Units to a share of the track in [0, 1]; ages outside go to its ends. */
export function toTrack(scale: AgeScale, age: number): number {
  const { first, last, now } = scale;
  if (age < 0) return first < 0 ? now * (1 - Math.min(age / first, 1)) : 0;
  return last > 0 ? now + (1 - now) * Math.min(age / last, 1) : now;
}

/** A share of the track to units. */
export function toAge(scale: AgeScale, track: number): number {
  const { first, last, now } = scale, at = Math.min(Math.max(track, 0), 1);
  if (at < now) return first * (1 - at / now);
  return now < 1 ? (last * (at - now)) / (1 - now) : 0;
}

/** The first of 1, 2, 5, 10, 20, 50, ... that parts the scale into at most `most` steps. */
export function evenStep(scale: AgeScale, most: number): number {
  const least = (scale.last - scale.first) / most;
  const decade = least > 0 ? 10 ** Math.floor(Math.log10(least)) : 1;
  // The factor forgives the last bit of a division: 150 units in 15 steps are steps of 10.
  return decade * ([1, 2, 5].find((k) => k * decade * (1 + 1e-9) >= least) ?? 10);
}
