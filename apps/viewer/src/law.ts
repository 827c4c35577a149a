// SPDX-License-Identifier: MIT
// Laws that are given by nodes: of the forecast, and of how far off it may be.

/** The two values of a law with nodes at an age of 0 or more: linear from 0 to and between them, held beyond. */
export function lawAt(nodes: readonly [number, number, number][], age: number): [number, number] {
  let before: readonly [number, number, number] = [0, 0, 0];
  for (const node of nodes) {
    if (age <= node[0]) {
      const share = (age - before[0]) / (node[0] - before[0]);
      return [before[1] + share * (node[1] - before[1]), before[2] + share * (node[2] - before[2])];
    }
    before = node;
  }
  return [before[1], before[2]];
}
