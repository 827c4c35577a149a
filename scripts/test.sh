#!/usr/bin/env bash
# Installs, builds and runs every test: the checks of the house, each room's tests, the program on
# good and bad input, the glTF validator, the viewer and a report in a real browser; then the rooms, and the
# program on bad input, again under the address and undefined-behavior sanitizers.
#   scripts/test.sh          all
#   scripts/test.sh --quick  without the sanitizers
# scripts/tidy.sh (clang-tidy) is separate: it takes long and finds taste more often than mistakes.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh build report viewer learn test
scripts/build.sh ci
ctest --preset ci -j2
# The trained forecasters, in a build of their own: the rest must not need libtorch. One test at a
# time, because libtorch takes all cores.
scripts/build.sh learn verdigris_cli verdigris_fixture verdigris_learn_test verdigris_study_test
ctest --preset learn -R '^(learn\.|study\.|cli\.learn)'
if [ "${1:-}" != --quick ]; then
  # The rooms that read what others made, and their neighbors; the rest follows by hand where needed.
  scripts/build.sh sanitize verdigris_cli verdigris_fixture verdigris_recording_test \
    verdigris_observe_test verdigris_forecast_test verdigris_material_test verdigris_simulate_test \
    verdigris_evaluate_test verdigris_results_test verdigris_report_test verdigris_metrics_test \
    verdigris_render_test verdigris_appearance_test verdigris_workflow_test verdigris_reproduce_test
  # fontconfig keeps its patterns behind pointers that the leak checker cannot follow.
  ASAN_OPTIONS=allocator_may_return_null=1 \
    LSAN_OPTIONS=suppressions="$PWD/tests/cli/leaks.txt":print_suppressions=0 \
    UBSAN_OPTIONS=print_stacktrace=1 ctest --preset sanitize -j2 \
    -R '^((recording|observe|forecast|material|evaluate|results|metrics|render|appearance|workflow|reproduce)\.|report\.[A-Z]|simulate\.(Spec|Scene|Camera|Coverage|Truth|GrayScott)|cli\.(bad_input|stages|simulate|compare|render|advice)$)'
fi
echo "All tests passed."
