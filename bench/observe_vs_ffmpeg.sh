#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The frame rate of observe() over that of `ffmpeg -i CLIP -f null -`, on the same clip, one after
# the other, best of three. Target: 0.8 or more, and at most 600 MB.
#   bench/observe_vs_ffmpeg.sh PATH_OF_observe_clip [CLIP]
# Without a CLIP, one minute of 1080p60 H.264 is made: a plate that darkens before a backdrop with
# grain. Encoding takes a few minutes.
set -euo pipefail
program=${1:?path of the program observe_clip}
clip=${2:-}
if [[ -z $clip ]]; then
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
    clip=$folder/plate.mp4
    seconds=${SECONDS_OF_CLIP:-60}
    ffmpeg -v error -f lavfi -i "color=c=0x777370:s=1920x1080:r=60:d=$seconds" \
        -f lavfi -i "color=c=0xB87350:s=800x700:r=60:d=$seconds,format=gbrp,\
hue=b='-2*t/$seconds':s='1-0.4*t/$seconds'" \
        -filter_complex "[0][1]overlay=560:190,noise=alls=6:allf=t,format=yuv420p" \
        -c:v libx264 -preset "${PRESET:-veryfast}" -crf 20 \
        -color_primaries bt709 -color_trc bt709 -colorspace bt709 -y "$clip"
fi
frames=$(ffprobe -v error -select_streams v:0 -count_packets \
    -show_entries stream=nb_read_packets -of csv=p=0 "$clip")
best() {  # the least wall time of three runs, seconds
    local least=1e9 start end
    for _ in 1 2 3; do
        start=$(date +%s.%N)
        "$@" >&2
        end=$(date +%s.%N)
        least=$(awk -v a="$least" -v b="$end" -v c="$start" 'BEGIN{t=b-c; print (t<a)?t:a}')
    done
    echo "$least"
}
reference=$(best ffmpeg -v error -i "$clip" -f null -)
awk -v n="$frames" -v t="$reference" 'BEGIN{printf "ffmpeg      %8.1f fps\n", n/t}'
for crop in none automatic; do
    seconds=$(best "$program" "$clip" "$crop")
    awk -v n="$frames" -v t="$seconds" -v r="$reference" -v c="$crop" \
        'BEGIN{printf "%-11s %8.1f fps   ratio %.2f\n", c, n/t, r/t}'
done
