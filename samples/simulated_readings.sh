# What samples have whose readings are simulated, to be sourced by their take_readings:
#
#   known     the coefficients, a line each: name, mean, and by what fraction single grains differ
#   take ...  one sheet
#   keep      all sheets, once every reading is there
#
# Before it: sample=FOLDER of the sample, root=FOLDER of the project.
repose=$root/build/release/cli/repose
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

sh "$root/setup.sh" release repose_program
cd -- "$sample"

columns() {
  case $1 in
    drops | drop_on_grains) echo drop_mm,rebound_mm ;;
    rolls) echo incline_deg,released_mm,stopped_mm ;;
    pendulums) echo release_deg,swing_deg ;;
    fills) echo bulk_density_kg_m3 ;;
    *) echo angle_deg ;;
  esac
}

# coefficients SEED SCATTER: options for grains that differ by SCATTER times what `known` says.
coefficients() {
  known | awk -v seed="$1" -v scatter="$2" '
    function normal() { return sqrt(-2 * log(1 - rand())) * cos(6.283185307 * rand()) }
    BEGIN { srand(seed); for (i = 0; i < 10; ++i) rand() }
    { printf "--set contact.%s=%.4f ", $1, $2 * (1 + scatter * $3 * normal()) }'
}

# take SHEET EXPERIMENT READINGS SCATTER STEP FORMAT [OPTION]...: a line for each reading, rounded to
# STEP. No pipe: what fails in one is not heard.
take() {
  sheet=$work/$1.csv experiment=$2 readings=$3 scatter=$4 step=$5 format=$6
  columns "$1" >"$sheet"
  # The study names its sheets, which must be there while it is simulated.
  mkdir -p -- readings
  [ -e "readings/$1.csv" ] || columns "$1" >"readings/$1.csv"
  shift 6
  seed=1
  while [ "$seed" -le "$readings" ]; do
    # shellcheck disable=SC2046
    "$repose" simulate "$experiment" study.toml --seed "$seed" $(coefficients "$seed" "$scatter") \
      "$@" >"$work/table"
    awk -v step="$step" -v format="$format\n" \
      '/^seed / { getline; printf format, step * int($2 / step + 0.5) }' "$work/table" >>"$sheet"
    seed=$((seed + 1))
  done
}

keep() { mv -- "$work"/*.csv readings; }
