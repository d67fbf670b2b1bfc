#include "calibrate/statistics/table/other_rows.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "calibrate/statistics/summary.h"

namespace repose::calibrate {

std::string unit_in(std::string_view cell) {
  // Each unit with its suffix in column names.
  constexpr std::string_view kUnits =
      " mm=mm cm=cm m=m µm=um um=um in=in inch=in deg=deg degree=deg degrees=deg °=deg grad=deg "
      "rad=rad g=g kg=kg mg=mg ml=ml l=l cm3=ml cm³=ml n=n kn=kn %=percent percent=percent "
      "kg/m3=kg_m3 kg/m³=kg_m3 g/l=kg_m3 g/cm3=g_cm3 g/cm³=g_cm3 t/m3=t_m3 s=s ms=ms min=min pa=pa "
      "mpa=mpa gpa=gpa rpm=rpm -=1 –=1 1=1 ";
  std::string text = " ";
  for (const char letter : cell) {
    if (std::string_view(" []()=").find(letter) != std::string_view::npos) continue;
    text += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  text += '=';
  const std::size_t found = text == " =" ? kUnits.npos : kUnits.find(text);
  if (found == kUnits.npos) return {};
  const std::size_t start = found + text.size();
  return std::string(kUnits.substr(start, kUnits.find(' ', start) - start));
}

namespace {

/// Lower-case letters only, without what is in brackets: "St. Dev. (n-1)" is stdev. Empty if there
/// is a digit: "mean 2" is a name.
std::string plain_word(std::string_view cell) {
  std::string word;
  for (const char letter : cell.substr(0, cell.find_first_of("(["))) {
    const auto byte = static_cast<unsigned char>(letter);
    if (std::isdigit(byte) != 0) return {};
    if (byte >= 0x80 || std::isalpha(byte) != 0) {
      word += static_cast<char>(byte >= 0x80 ? byte : std::tolower(byte));
    }
  }
  return word;
}

/// In English, German, French, Spanish, Italian, Portuguese, Dutch, Polish, Czech, Swedish, Danish,
/// Norwegian, Finnish, Hungarian, Turkish, Russian, Chinese, Japanese and Korean. All others are
/// recognised by their numbers.
bool is_statistic(std::string_view cell) {
  constexpr std::string_view kWords =
      " mean means average avg median sd stdev stddev stdv std sdev standarddeviation stdeviation "
      "se sem "
      "stderr standarderror variance var cv cov rsd coefficientofvariation min minimum max maximum "
      "sum total count range ci confidenceinterval mittelwert mittel mittelw mw durchschnitt "
      "standardabweichung stabw stdabw standardabw varianz summe gesamt anzahl spannweite "
      "standardfehler variationskoeffizient moyenne moy médiane écarttype Écarttype ecarttype "
      "somme "
      "media promedio mediana desviaciónestándar desviacionestandar desviacióntípica desvest suma "
      "varianza deviazionestandard devst somma média desviopadrão desviopadrao desvpad soma "
      "gemiddelde standaardafwijking standaarddeviatie średnia Średnia srednia "
      "odchyleniestandardowe odchstandardowe průměr prumer směrodatnáodchylka smodch medelvärde "
      "standardavvikelse gennemsnit gjennomsnitt standardafvigelse standardavvik keskiarvo "
      "keskihajonta átlag Átlag szórás ortalama standartsapma среднее Среднее "
      "стандартноеотклонение Стандартноеотклонение ско СКО 平均 平均值 均值 标准差 标准偏差 "
      "標準偏差 "
      "標準差 평균 표준편차 x̄ ø Ø σ ";
  const std::string word = plain_word(cell);
  return !word.empty() && kWords.find(' ' + word + ' ') != kWords.npos;
}

std::vector<std::size_t> places_of(const Table& table, std::span<const std::string> names) {
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    if (const auto place = table.column(name)) places.push_back(*place);
  }
  return places;
}

void take_units(Table& table, std::span<const std::size_t> numbers, OtherRows& other,
                base::Faults& errors) {
  if (table.rows.empty() || numbers.empty()) return;
  const TableRow& row = table.rows.front();
  bool any = false;
  for (const std::size_t place : numbers) {
    const std::string& cell = row.cells[place];
    if (cell.empty() || (cell == "1" && numbers.size() > 1)) continue;
    if (number_of(cell) || unit_in(cell).empty()) return;
    any = true;
  }
  if (!any) return;
  for (const std::size_t place : numbers) {
    constexpr std::array<std::string_view, 6> kNamed = {"mm", "deg", "g", "ml", "percent", "kg_m3"};
    const std::string& name = table.columns[place];
    const std::string unit = unit_in(row.cells[place]);
    for (const std::string_view named : kNamed) {
      if (unit.empty() || unit == named || !name.ends_with(fmt::format("_{}", named))) continue;
      errors.add({.where = fmt::format("{}:{}", table.name, row.line),
                  .value = fmt::format("{} is in \"{}\" by its row of units, and in {} by its name",
                                       name, row.cells[place], named),
                  .fix = "convert the numbers, or correct the unit."});
    }
  }
  other.left_out.push_back({fmt::format("line {}", row.line), "units"});
  table.rows.erase(table.rows.begin());
}

/// "min" and "max" may also be names of levels, which recur.
bool is_label(const Table& table, std::size_t place, const std::string& cell) {
  if (!is_statistic(cell)) return false;
  constexpr auto kLevels = std::to_array<std::string_view>(
      {"min", "minimum", "max", "maximum", "range", "total", "sum", "count", "var", "std"});
  if (std::find(kLevels.begin(), kLevels.end(), plain_word(cell)) == kLevels.end()) return true;
  return std::count_if(table.rows.begin(), table.rows.end(),
                       [&](const TableRow& row) { return row.cells[place] == cell; }) == 1;
}

/// Number of readings, or their scatter: the name of a sample unless something shows that the
/// samples have ended.
bool is_short_label(const std::string& cell) {
  const std::string word = plain_word(cell);
  return word == "n" || word == "s" || word == "u" || word == "k";
}

bool has_short_label(const TableRow& row) { return std::ranges::any_of(row.cells, is_short_label); }

/// First line labelled as a statistic, or as the number of readings directly above that.
int first_labelled_line(const Table& table) {
  const auto has_label = [&](const TableRow& row) {
    for (std::size_t place = 0; place < row.cells.size(); ++place) {
      if (is_label(table, place, row.cells[place])) return true;
    }
    return false;
  };
  auto first = std::ranges::find_if(table.rows, has_label);
  if (first == table.rows.end()) return std::numeric_limits<int>::max();
  while (first != table.rows.begin() && has_short_label(*std::prev(first))) --first;
  return first->line;
}

/// Rows labelled as a statistic. Rows below the first of them are not readings.
void take_labelled(Table& table, OtherRows& other, base::Faults& errors) {
  const Table whole = table;
  const int first_line = first_labelled_line(table);
  std::erase_if(table.rows, [&](const TableRow& row) {
    const bool any = row.line >= first_line;
    for (std::size_t place = 0; place < row.cells.size(); ++place) {
      const std::string& cell = row.cells[place];
      if (!is_label(whole, place, cell) && !(any && is_short_label(cell))) continue;
      other.left_out.push_back(
          {fmt::format("line {}", row.line), fmt::format("labelled \"{}\"", cell)});
      return true;
    }
    if (any) {
      errors.add({.where = fmt::format("{}:{}", table.name, row.line),
                  .value = "stands below a row labelled as a statistic",
                  .rule = "readings stand above their mean",
                  .fix = "move it up if it is one, or delete it."});
    }
    return any;
  });
}

/// Place value of the last digit written.
double step_of(std::string_view cell) {
  const std::size_t mark = cell.find_first_of(".,");
  const auto decimals = mark == std::string_view::npos ? 0 : cell.size() - mark - 1;
  return std::pow(10., -static_cast<double>(decimals));
}

/// Mean, scatter and so on of some numbers.
class Statistics {
 public:
  explicit Statistics(std::vector<double> values) : n_(static_cast<double>(values.size())) {
    double sum = 0, squares = 0;
    for (const double value : values) sum += value;
    mean_ = sum / n_;
    for (const double value : values) squares += (value - mean_) * (value - mean_);
    sd_ = std::sqrt(squares / (n_ - 1));
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    const double median =
        values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
    const double least = values.front(), greatest = values.back();
    derived_ = {mean_,     sd_, std::sqrt(squares / n_), sd_ / std::sqrt(n_),
                sd_ * sd_, sum, greatest - least,        n_};
    if (mean_ != 0) {
      constexpr double kPercent = 100;
      derived_.push_back(sd_ / mean_);
      derived_.push_back(kPercent * sd_ / mean_);
    }
    readings_ = {median, least, greatest};
    values_ = std::move(values);
  }

  bool vary() const { return sd_ > 0; }
  bool is_mean(double value, double step) const { return is_same(value, mean_, step); }

  /// One of mean, scatter and so on, and not a reading.
  bool is_derived(double value, double step) const {
    return std::ranges::any_of(derived_, [&](double one) { return is_same(value, one, step); });
  }

  /// Probability that a further reading equals any of them to the digits written; std::nullopt:
  /// this one does not. Readings recur, so equalling the smallest of them means nothing: 1.
  std::optional<double> chance_of(double value, double step) const {
    const auto is_it = [&](double one) { return is_same(value, one, step); };
    if (!is_derived(value, step)) {
      const bool is_reading = std::any_of(readings_.begin(), readings_.end(), is_it);
      return is_reading ? std::optional(1.) : std::nullopt;
    }
    if (!vary()) return is_it(mean_) ? 1 : 1e-3;
    double chance = 0;
    std::vector<double> counted;
    for (const double one : derived_) {
      const double written = std::round(one / step);
      if (std::find(counted.begin(), counted.end(), written) != counted.end()) continue;
      counted.push_back(written);
      chance += step * density_at(one);
    }
    const auto repeats = std::count_if(values_.begin(), values_.end(),
                                       [&](double other) { return is_same(value, other, step); });
    return std::min(1., std::max(chance, static_cast<double>(repeats) / n_));
  }

 private:
  static bool is_same(double value, double one, double step) {
    constexpr double kHalf = .5 + 1e-6;
    return std::abs(value - one) <= kHalf * step;
  }
  /// Density of a further reading: mean + s sqrt(1 + 1/n) t, Student's t of n - 1 degrees of
  /// freedom.
  double density_at(double value) const {
    const double df = n_ - 1, width = sd_ * std::sqrt(1 + 1 / n_);
    const double t = (value - mean_) / width;
    const double top = std::exp(std::lgamma((df + 1) / 2) - std::lgamma(df / 2)) /
                       std::sqrt(df * std::numbers::pi);
    return top * std::pow(1 + t * t / df, -(df + 1) / 2) / width;
  }

  double n_, mean_ = 0, sd_ = 0;
  std::vector<double> values_;
  std::vector<double> derived_;   ///< calculated from them
  std::vector<double> readings_;  ///< those that are readings themselves, or may be
};

/// Letters become "a", a run of digits "0": the common pattern of sample names.
std::string shape_of(std::string_view label) {
  std::string shape;
  for (const char letter : label) {
    const auto byte = static_cast<unsigned char>(letter);
    const char kind = std::isdigit(byte) != 0 ? '0' : std::isalpha(byte) != 0 ? 'a' : letter;
    if (kind != '0' || !shape.ends_with('0')) shape += kind;
  }
  return shape;
}

/// Looks for statistics of the rows above in the last rows.
class Footer {
 public:
  Footer(const Table& table, std::span<const std::size_t> readings)
      : table_(table), readings_(readings) {}

  /// Probability that readings look like that; std::nullopt: they do not.
  std::optional<double> chance_of_last(std::size_t count) const {
    const std::size_t head = table_.rows.size() - count;
    double chance = 1;
    for (const std::size_t place : readings_) {
      const auto values = values_of(place, head);
      if (!values) return std::nullopt;
      const Statistics statistics(*values);
      for (std::size_t row = head; row < table_.rows.size(); ++row) {
        const std::string& cell = table_.rows[row].cells[place];
        const auto value = number_of(cell);
        if (!value) return std::nullopt;
        const auto one = statistics.chance_of(*value, step_of(cell));
        if (!one) return std::nullopt;
        chance *= *one;
      }
    }
    constexpr double kOtherLabel = .02;
    for (std::size_t row = head; row < table_.rows.size(); ++row) {
      if (is_labelled_otherwise(row, head)) chance *= kOtherLabel;
    }
    return chance;
  }

  /// Whether the last rows of a table of runs summarise those above, in settings as in readings:
  /// see take_other_rows().
  bool last_tell_of_runs(std::span<const std::size_t> settings, std::size_t count) const {
    constexpr double kUnlikely = .01, kUnlikelyReadings = .05;
    const std::size_t head = table_.rows.size() - count;
    double of_settings = 1, of_readings = 1;
    bool are_labelled_otherwise = true;
    for (std::size_t row = head; row < table_.rows.size(); ++row) {
      const auto tells = [&](std::size_t place) {
        const std::vector<double> above = numbers_in(place, head);
        const std::string& cell = table_.rows[row].cells[place];
        const auto value = number_of(cell);
        if (!value || above.size() < 2) return false;
        const Statistics statistics(above);
        if (!statistics.vary() || !statistics.is_derived(*value, step_of(cell))) return false;
        of_settings *= statistics.chance_of(*value, step_of(cell)).value_or(1);
        return true;
      };
      if (!std::ranges::all_of(settings, tells)) return false;
      of_readings *= chance_of_readings(row, head);
      are_labelled_otherwise = are_labelled_otherwise && is_labelled_otherwise(row, head);
    }
    return are_labelled_otherwise
               ? of_settings * of_readings < kUnlikely
               : of_readings < kUnlikelyReadings && of_settings * of_readings < kUnlikely;
  }

  bool last_is_mean() const {
    const std::size_t head = table_.rows.size() - 1;
    bool any = false;
    for (const std::size_t place : readings_) {
      const auto values = values_of(place, head);
      const std::string& cell = table_.rows.back().cells[place];
      const auto value = number_of(cell);
      if (!values || !value) return false;
      const Statistics statistics(*values);
      if (!statistics.is_mean(*value, step_of(cell))) return false;
      any = any || statistics.vary();
    }
    return any;
  }

 private:
  /// Failed runs have none.
  std::vector<double> numbers_in(std::size_t place, std::size_t rows) const {
    std::vector<double> values;
    for (std::size_t row = 0; row < rows; ++row) {
      if (const auto value = number_of(table_.rows[row].cells[place])) values.push_back(*value);
    }
    return values;
  }

  /// Probability that readings of a run all equal mean, scatter and so on of those above; 1 if one
  /// does not, or if there is none.
  double chance_of_readings(std::size_t row, std::size_t head) const {
    double chance = 1;
    for (const std::size_t place : readings_) {
      const std::string& cell = table_.rows[row].cells[place];
      const auto value = number_of(cell);
      const std::vector<double> above = numbers_in(place, head);
      if (!value || above.size() < 2) continue;
      const auto one = Statistics(above).chance_of(*value, step_of(cell));
      if (!one) return 1;
      chance *= *one;
    }
    return chance;
  }

  std::optional<std::vector<double>> values_of(std::size_t place, std::size_t rows) const {
    std::vector<double> values;
    for (std::size_t row = 0; row < rows; ++row) {
      const auto value = number_of(table_.rows[row].cells[place]);
      if (!value) return std::nullopt;
      values.push_back(*value);
    }
    return values;
  }

  /// With text, or nothing, in a column whose cells above are all of one kind.
  bool is_labelled_otherwise(std::size_t row, std::size_t head) const {
    for (std::size_t place = 0; place < table_.columns.size(); ++place) {
      const std::string& label = table_.rows[row].cells[place];
      if (number_of(label)) continue;
      const std::string shape = shape_of(table_.rows.front().cells[place]);
      const auto is_alike = [&](const TableRow& one) {
        return shape_of(one.cells[place]) == shape;
      };
      const auto end = table_.rows.begin() + static_cast<std::ptrdiff_t>(head);
      if (std::all_of(table_.rows.begin(), end, is_alike) && shape_of(label) != shape) {
        return true;
      }
    }
    return false;
  }

  const Table& table_;
  std::span<const std::size_t> readings_;
};

/// "this last row looks like", or "lines 5 to 6 look like".
std::string last_rows_text(const Table& table, std::size_t count) {
  if (count == 1) return "this last row looks like";
  return fmt::format("lines {} to {} look like", table.rows[table.rows.size() - count].line,
                     table.rows.back().line);
}

/// Rows at the end of a table of runs that are calculated from those above.
void find_unlabelled_of_runs(const Table& table, std::span<const std::size_t> readings,
                             std::span<const std::size_t> settings, base::Faults& errors) {
  constexpr std::size_t kMaxRows = 8, kFewestRuns = 3;
  if (settings.empty() || table.rows.size() <= kFewestRuns) return;
  const Footer footer(table, readings);
  for (std::size_t count = std::min(kMaxRows, table.rows.size() - kFewestRuns); count > 0;
       --count) {
    if (!footer.last_tell_of_runs(settings, count)) continue;
    errors.add(
        {.where = fmt::format("{}:{}", table.name, table.rows[table.rows.size() - count].line),
         .value = fmt::format("{} mean, scatter or the like of the runs above, not runs",
                              last_rows_text(table, count)),
         .fix =
             fmt::format("delete {}; a run that happens to be so counts if it stands above others.",
                         count == 1 ? "it" : "them")});
    return;
  }
}

void find_unlabelled(const Table& table, std::span<const std::size_t> readings,
                     Unlabelled unlabelled, OtherRows& other, base::Faults& errors) {
  constexpr std::size_t kMaxRows = 8, kFewestReadings = 2;
  constexpr double kUnlikely = .01;
  if (readings.empty() || table.rows.size() <= kFewestReadings) return;
  const Footer footer(table, readings);
  const std::size_t most = std::min(kMaxRows, table.rows.size() - kFewestReadings);
  for (std::size_t count = unlabelled == Unlabelled::refused ? most : 0; count > 0; --count) {
    const auto chance = footer.chance_of_last(count);
    if (!chance || *chance >= kUnlikely) continue;
    errors.add(
        {.where = fmt::format("{}:{}", table.name, table.rows[table.rows.size() - count].line),
         .value = fmt::format("{} mean, scatter or the like of the rows above, not readings",
                              last_rows_text(table, count)),
         .fix = fmt::format(
             "delete {}; readings that happen to be so count if they stand above others.",
             count == 1 ? "it" : "them")});
    return;
  }
  if (!footer.last_is_mean()) return;
  other.notes.push_back(fmt::format(
      "{}:{}: equals the mean of the rows above, and counts as a reading. If it is their mean, "
      "delete it.",
      table.name, table.rows.back().line));
}

/// If grains mostly stay where they fell, those that rebound are not slips.
bool are_mostly_equal(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return 2 * std::ranges::count(values, *middle) > std::ssize(values);
}

/// Readings that count, but may be slips of the pen.
void note_outliers(const Table& table, std::size_t place, const std::vector<double>& values,
                   OtherRows& other) {
  constexpr double kUnlikely = .001;
  if (are_mostly_equal(values)) return;
  for (const std::size_t far : outliers_of(values, kUnlikely)) {
    other.notes.push_back(fmt::format(
        "{}:{}: {} = {} lies far from the other readings (of normal ones, less than one table in "
        "1000 has such), and counts. If it is a slip or no reading, correct or delete it.",
        table.name, table.rows[far].line, table.columns[place], table.rows[far].cells[place]));
  }
}

/// A column of small numbers may be in a different unit from what its name says.
void note_other_unit(const Table& table, const std::string& name, double most, OtherRows& other) {
  constexpr double kRightAngle_rad = 1.58, kWhole = 1;
  if (most > 0 && most < kRightAngle_rad && name.ends_with("_deg")) {
    other.notes.push_back(
        fmt::format("{}: {} is at most {:g}: degrees are expected. If these are radians, multiply "
                    "them by 57.2958.",
                    table.name, name, most));
  }
  if (most > 0 && most <= kWhole && name.ends_with("_percent")) {
    other.notes.push_back(fmt::format(
        "{}: {} is at most {:g}: percent are expected. If these are fractions, multiply "
        "them by 100.",
        table.name, name, most));
  }
}

void note_doubtful(const Table& table, std::span<const std::size_t> readings, OtherRows& other) {
  for (const std::size_t place : readings) {
    std::vector<double> values;
    for (const TableRow& row : table.rows) {
      if (const auto value = number_of(row.cells[place])) values.push_back(*value);
    }
    // Cells that are not numbers are refused elsewhere.
    if (values.empty() || values.size() < table.rows.size()) continue;
    note_outliers(table, place, values, other);
    note_other_unit(table, table.columns[place], *std::ranges::max_element(values), other);
  }
}

}  // namespace

OtherRows take_other_rows(Table& table, std::span<const std::string> readings,
                          Unlabelled unlabelled, base::Faults& errors,
                          std::span<const std::string> settings) {
  OtherRows other;
  const std::vector<std::size_t> places = places_of(table, readings);
  take_units(table, places, other, errors);
  take_labelled(table, other, errors);
  find_unlabelled_of_runs(table, places, places_of(table, settings), errors);
  find_unlabelled(table, places, unlabelled, other, errors);
  if (unlabelled == Unlabelled::refused) note_doubtful(table, places, other);
  return other;
}

}  // namespace repose::calibrate
