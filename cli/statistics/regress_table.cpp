#include "cli/statistics/regress_table.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/common/terminal.h"

namespace repose::cli {
namespace {

constexpr std::size_t kNameWidth = 16;
constexpr const char* kNothing = "–";

std::string p_text(const std::optional<double>& p) {
  constexpr double kTiny = 1e-4;
  if (!p) return kNothing;
  return *p < kTiny ? fmt::format("{:.1e}", *p) : fmt::format("{:.4f}", *p);
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : kNothing;
}

/// Lines of text, for a terminal of some width.
class Page {
 public:
  explicit Page(int columns) : columns_(static_cast<std::size_t>(std::max(40, columns))) {}

  void add(const std::string& line) { text_ += line + '\n'; }
  /// A name that is too long for its column gets a line of its own.
  void add_row(const std::string& name, const std::string& cells) {
    if (letters(name) <= kNameWidth) {
      add(padded(name, kNameWidth) + cells);
    } else {
      add(name);
      add(padded("", kNameWidth) + cells);
    }
  }
  /// The text broken into lines that begin below each other, after `mark`.
  void add_wrapped(const std::string& mark, const std::string& text) {
    std::string before = mark;
    for (const std::string& line : wrapped(text, columns_ - letters(mark))) {
      add(before + line);
      before = std::string(letters(mark), ' ');
    }
  }
  const std::string& text() const { return text_; }

 private:
  std::size_t columns_;
  std::string text_;
};

std::string levels_text(const calibrate::Regression& fit, const std::vector<double>& levels) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    parts.push_back(fmt::format("{} = {:.4g}", fit.factors[i].name, levels[i]));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void add_heading(const calibrate::Regression& fit, Page& page) {
  std::vector<std::string> names, codings;
  for (const calibrate::Factor& factor : fit.factors) {
    names.push_back(factor.name);
    codings.push_back(fmt::format("{} {:g} … {:g}", factor.name, factor.low, factor.high));
  }
  page.add_wrapped("", fmt::format("{} from {}: {} model, {} runs", fit.response_name,
                                   fmt::join(names, ", "), name_of(fit.model), fit.runs.size()));
  page.add_wrapped("", fmt::format("coded -1 … 1 are {}", fmt::join(codings, ", ")));
}

void add_coefficients(const calibrate::Regression& fit, Page& page) {
  page.add("");
  page.add_row("term", fmt::format("{:>10}{:>10}{:>9}{:>9}{}", "coded", "st. error", "t", "p",
                                   right_aligned("95 % interval", 24)));
  for (const calibrate::Coefficient& coefficient : fit.coefficients) {
    const std::string interval =
        fit.is_exact
            ? kNothing
            : fmt::format("{:.4g} … {:.4g}", coefficient.interval[0], coefficient.interval[1]);
    const std::string t = coefficient.t ? fmt::format("{:.2f}", *coefficient.t) : kNothing;
    page.add_row(name_of(coefficient.term, fit.factors),
                 fmt::format("{:>10.4g}{:>10.4g}{}{}{}", coefficient.value,
                             coefficient.standard_error, right_aligned(t, 9),
                             right_aligned(p_text(coefficient.p), 9), right_aligned(interval, 24)));
  }
}

/// The surface of the factors in their own units; nothing where these are the coded ones.
void add_equation(const calibrate::Regression& fit, Page& page) {
  const bool is_coded = std::all_of(
      fit.factors.begin(), fit.factors.end(),
      [](const calibrate::Factor& factor) { return factor.low == -1 && factor.high == 1; });
  if (is_coded) return;
  std::string equation = fit.response_name + " =";
  for (const calibrate::Coefficient& coefficient : fit.coefficients) {
    const double value = coefficient.natural;
    const bool is_first = coefficient.term.empty();
    const char* sign = is_first ? (value < 0 ? "-" : "") : (value < 0 ? "- " : "+ ");
    equation += fmt::format(" {}{:.6g}", sign, std::abs(value));
    if (!is_first) equation += ' ' + name_of(coefficient.term, fit.factors);
  }
  page.add_wrapped("", equation);
}

void add_variance(const std::string& name, const calibrate::Variance& variance, Page& page) {
  const std::string mean =
      variance.df > 0 ? fmt::format("{:.4g}", variance.mean_square()) : kNothing;
  page.add_row(name, fmt::format("{:>16.6g}{:>6}{}{}{}", variance.sum_of_squares, variance.df,
                                 right_aligned(mean, 14), right_aligned(cell(variance.f), 12),
                                 right_aligned(p_text(variance.p), 10)));
}

void add_anova(const calibrate::Regression& fit, Page& page) {
  page.add("");
  page.add_row("source", fmt::format("{:>16}{:>6}{:>14}{:>12}{:>10}", "sum of squares", "df",
                                     "mean square", "F", "p"));
  add_variance("model", fit.explained, page);
  for (const calibrate::Coefficient& coefficient : fit.coefficients) {
    if (coefficient.term.empty()) continue;
    add_variance("  " + name_of(coefficient.term, fit.factors), coefficient.partial, page);
  }
  add_variance("residual", fit.residual, page);
  if (fit.lack_of_fit) add_variance("  lack of fit", *fit.lack_of_fit, page);
  if (fit.pure_error) add_variance("  pure error", *fit.pure_error, page);
  add_variance("total", fit.total, page);
  for (std::size_t i = 0; i < fit.factors.size(); ++i) {
    add_variance("all of " + fit.factors[i].name, fit.of_factor[i], page);
  }
  page.add_wrapped("", "Sums of squares of terms are partial: what the fit loses without them.");
  page.add("");
  page.add_wrapped(
      "", fmt::format("R² {:.4f}, adjusted {:.4f}, predicted {}; residual sd {:.4g}", fit.r2,
                      fit.r2_adjusted,
                      fit.r2_predicted ? fmt::format("{:.4f}", *fit.r2_predicted) : kNothing,
                      fit.residual_sd));
}

std::string point_text(const calibrate::Regression& fit, const calibrate::SurfacePoint& point) {
  return fmt::format("{:.4g} ± {:.3g} at {}", point.value, point.uncertainty,
                     levels_text(fit, point.natural));
}

void add_shape(const SurfaceReport& report, Page& page) {
  const calibrate::Regression& fit = report.fit;
  page.add("");
  if (report.form) {
    for (const calibrate::CanonicalAxis& axis : report.form->axes) {
      if (fit.factors.size() == 1) continue;  // the square's coefficient is in the table above
      page.add_wrapped(padded("curvature", kNameWidth),
                       fmt::format("{:.4g} ± {:.3g} along {} (coded)", axis.curvature,
                                   axis.uncertainty, levels_text(fit, axis.direction)));
    }
    if (report.form->stationary) {
      page.add_wrapped(
          padded(std::string(name_of(report.form->shape)), kNameWidth),
          fmt::format("{}, {} the runs' box", point_text(fit, *report.form->stationary),
                      report.form->is_inside ? "inside" : "outside"));
    }
  }
  page.add_wrapped(padded("lowest in box", kNameWidth), point_text(fit, report.extremes.least));
  page.add_wrapped(padded("highest in box", kNameWidth), point_text(fit, report.extremes.greatest));
}

std::string range_text(const calibrate::Factor& factor,
                       const std::vector<std::array<double, 2>>& ranges,
                       const std::array<double, 2>& box) {
  std::vector<std::string> parts;
  for (const auto& [low, high] : ranges) {
    parts.push_back(fmt::format("{:.4g} … {:.4g}", factor.natural(low), factor.natural(high)));
  }
  const bool is_all = ranges.size() == 1 && ranges.front() == box;
  return fmt::format("{}{}", fmt::join(parts, " and "), is_all ? ", all of the box" : "");
}

void add_target(const SurfaceReport& report, Page& page) {
  if (!report.target || !report.target->is_reached) return;
  const calibrate::Regression& fit = report.fit;
  page.add("");
  page.add_wrapped(
      "", fmt::format("{} = {:g} within the runs' box", fit.response_name, report.target->target));
  const bool is_single = fit.factors.size() == 1;
  for (std::size_t i = 0; i < fit.factors.size() && !is_single; ++i) {
    page.add_wrapped(padded("  " + fit.factors[i].name, kNameWidth) + ' ',
                     range_text(fit.factors[i], report.target->ranges[i], fit.box[i]));
  }
  if (!is_single && !report.target->through_centre.empty()) {
    page.add_wrapped("", "with all other factors in the middle of their ranges");
  }
  for (const calibrate::Crossing& crossing : report.target->through_centre) {
    const std::size_t i = crossing.factor;
    page.add_wrapped("  ",
                     fmt::format("{} = {:.4g}{}", fit.factors[i].name, crossing.point.natural[i],
                                 crossing.natural_uncertainty
                                     ? fmt::format(" ± {:.2g}", *crossing.natural_uncertainty)
                                     : ""));
  }
}

}  // namespace

std::string regress_table(const SurfaceReport& report, int columns) {
  Page page(columns);
  add_heading(report.fit, page);
  add_coefficients(report.fit, page);
  add_equation(report.fit, page);
  add_anova(report.fit, page);
  add_shape(report, page);
  add_target(report, page);
  if (!report.diagnostics.empty()) page.add("");
  for (const calibrate::SurfaceDiagnostic& diagnostic : report.diagnostics)
    page.add_wrapped("! ", diagnostic.message);
  return page.text();
}

}  // namespace repose::cli
