#!/usr/bin/env bash
# Installs libtorch (550 MB) and builds Verdigris with the trained forecasters, beside the usual
# build:  scripts/build_learn.sh   ->  build/learn/bin/verdigris
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install_packages.sh build report viewer learn
scripts/build.sh learn verdigris_cli
echo "Built build/learn/bin/verdigris. Try next:  build/learn/bin/verdigris train --help"
