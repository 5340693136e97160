#!/usr/bin/env bash
# Build the wheel, install it into a clean environment outside the checkout, and use it there.
set -euo pipefail
cd "$(dirname "$0")/../.."
python=${1:-python3}
checkout=$PWD
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

"$python" -m venv "$place/environment"
"$place/environment/bin/python" -m pip install --quiet --upgrade pip
"$place/environment/bin/pip" wheel --quiet --no-deps --wheel-dir "$place" .
"$place/environment/bin/pip" install --quiet --constraint constraints.txt "$place"/workbench-*.whl

# From here on nothing of the checkout may be needed.
cd "$place"
unset WORKBENCH_DATA PYTHONPATH
export WORKBENCH_CACHE="$place/cache"
bin=$place/environment/bin
where=$("$bin/python" -c 'import workbench; print(workbench.__file__)')
case "$where" in
"$checkout"/*) echo "workbench was imported from the checkout: $where" >&2 && exit 1 ;;
esac
"$bin/workbench" datasets check
"$bin/workbench" compact cmu/01_01-jump --projector pca --optimize --json
"$bin/workbench" reproduce costa2018:fig5.13 --out "$place/report"
test -s "$place/report/index.html"
"$bin/workbench" reproduce costa2018:fig5.13 --list --json --out "$place/report" | grep -q '"state": "done"'
echo "The wheel works outside the checkout."
