#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The frame rate of observe() over that of `ffmpeg -i CLIP -f null -`, on the same clip, taking
# turns; the median of five rounds' ratios. Target: 0.8 or more, and at most 600 MB.
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
taken() {  # wall seconds
    local start end
    start=$(date +%s.%N)
    "$@" >/dev/null 2>&1
    end=$(date +%s.%N)
    awk -v a="$start" -v b="$end" 'BEGIN{print b-a}'
}
median() { sort -g | awk '{v[NR]=$1} END{print (NR%2) ? v[(NR+1)/2] : (v[NR/2]+v[NR/2+1])/2}'; }
rounds=${ROUNDS:-5}
declare -A ratios
for ((i = 0; i < rounds; ++i)); do
    reference=$(taken ffmpeg -v error -i "$clip" -f null -)
    for crop in none automatic; do
        seconds=$(taken "$program" "$clip" "$crop")
        ratios[$crop]+="$(awk -v t="$seconds" -v r="$reference" 'BEGIN{print r/t}') "
    done
    awk -v n="$frames" -v t="$reference" 'BEGIN{printf "ffmpeg %.0f fps\n", n/t}'
done
for crop in none automatic; do
    printf '%-10s ratio %.2f (' "$crop" "$(tr ' ' '\n' <<<"${ratios[$crop]}" | grep . | median)"
    printf '%.2f ' ${ratios[$crop]}
    "$program" "$clip" "$crop" 2>/dev/null | sed 's/.*"peak_mb": \([0-9]*\).*/) peak \1 MB/'
done
