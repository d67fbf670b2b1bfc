#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/distributions.h"
#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"
#include "vision/scan/scan_file.h"

/// Formulas: calibrate/fit/THEORY.md, dem/THEORY.md and vision/measure/repose_angle.h, which give
/// their sources and the tests that prove them.

namespace repose::calibrate::report {

namespace {

void add(DataTable& data, const std::string& what, const std::string& value) {
  data.add({what, shortened(value, 280)});
}

std::string percent(double fraction) { return shown(100 * fraction, 2) + " %"; }

std::string by_experiment(const NamedValues& values, const char* unit) {
  std::string text;
  for (const auto& [experiment, value] : values) {
    if (!text.empty()) text += ", ";
    text += fmt::format("{} {}{}", shortened(experiment), shown(value), unit);
  }
  return text.empty() ? "–" : text;
}

/// "1 … 188"
std::string seeds_text(const std::vector<Run>& runs) {
  if (runs.empty()) return "–";
  const auto [least, greatest] = std::minmax_element(
      runs.begin(), runs.end(),
      [](const Run& one, const Run& other) { return one.job.seed < other.job.seed; });
  return fmt::format("{} … {}, one per simulation", least->job.seed, greatest->job.seed);
}

std::string settings_text(const std::vector<std::string>& settings) {
  std::string text;
  for (const std::string& setting : settings) text += "--set " + setting + ' ';
  return text.empty() ? "none" : text;
}

void add_study(const StudyIdentity& study, DataTable& data) {
  add(data, "program", study.program);
  add(data, "study file", study.file);
  add(data, "hash of the study", study.hash);
  add(data, "settings (--set)", settings_text(study.settings));
  add(data, "method", study.method);
  if (!study.budget.empty()) add(data, "budget", study.budget + ": " + study.budget_description);
}

void add_model(const StudyResult& result, DataTable& data) {
  const ModelFacts& from = *result.provenance.model;
  add(data, "first seed", fmt::format("{}", from.first_seed));
  if (const auto* joint = std::get_if<JointResult>(&result.found)) {
    add(data, "seeds", seeds_text(joint->runs));
  }
  if (from.simulator) {
    add(data, "simulated by", from.simulator->name);
    add(data, "other than our own engine",
        fmt::format("{}", fmt::join(from.simulator->differences, " ")));
  }
  add(data, "contact model", from.contact_model);
  add(data, "damping", from.damping + ": " + from.damping_definition);
  add(data, "rolling friction", from.rolling_model + ": " + from.rolling_definition);
  add(data, "clump",
      fmt::format("{}, {} sphere{}", from.clump.source, from.clump.spheres,
                  from.clump.spheres == 1 ? "" : "s"));
  add(data, "clump volume error", percent(from.clump.volume_error));
  add(data, "clump inertia error", percent(from.clump.inertia_error));
  if (from.clump.size_sd_percent) {
    add(data, "standard deviation of sizes", fmt::format("{:.3g} %", *from.clump.size_sd_percent));
  }
  if (from.heap_definition) {
    add(data, "definition of a heap's angle", text_of(*from.heap_definition));
    const std::string simulated = simulated_text(*from.heap_definition);
    if (!simulated.empty()) add(data, "mean angle of the heaps simulated last", simulated);
  }
  const std::vector<std::string>& assumed = result.provenance.assumed;
  if (!assumed.empty()) {
    add(data, "marked as assumed in the study", fmt::format("{}", fmt::join(assumed, ", ")));
  }
  add(data, "fraction of the real stiffness", by_experiment(from.stiffness_factor, ""));
  add(data, "shortest time step", by_experiment(from.shortest_timestep_s, " s"));
}

void add_table(const TableFacts& table, DataTable& data) {
  if (table.engine) {
    add(data, "runs",
        fmt::format("{}, of which {} failed, by the study's command: {}", table.engine->runs,
                    table.engine->failed, table.engine->command));
  } else {
    add(data, "runs", "made with another program, and given as a table");
  }
  add(data, "table", fmt::format("{}", fmt::join(table.files, ", ")));
  add(data, "rows", fmt::format("{}", table.rows));
  add(data, "rows of failed runs", fmt::format("{}", table.failed));
  add(data, "rows without any reading", fmt::format("{}", table.without_reading));
  add(data, "rows left out", fmt::format("{}", table.left_out));
}

std::vector<std::string> warnings_of(const StudyResult& result) {
  if (const auto* joint = std::get_if<JointResult>(&result.found)) return joint->warnings;
  std::vector<std::string> warnings;
  for (const SurfaceDiagnostic& warning : std::get<PublishedResult>(result.found).warnings) {
    warnings.push_back(warning.message);
  }
  return warnings;
}

}  // namespace

Chapter provenance_chapter(const ReportedStudy& study) {
  Chapter chapter{.id = "provenance", .title = "Provenance", .blocks = {}};
  Table table{.name = "provenance",
              .title = {},
              .data = {.columns = {{.name = "item", .unit = {}}, {.name = "value", .unit = {}}},
                       .rows = {}}};
  if (study.study) add_study(*study.study, table.data);
  if (study.result && study.result->provenance.model) add_model(*study.result, table.data);
  if (study.result && study.result->provenance.table) {
    add_table(*study.result->provenance.table, table.data);
    chapter.blocks.push_back(std::move(table));
    return chapter;
  }
  const auto failed = std::count_if(study.runs.begin(), study.runs.end(),
                                    [](const SavedRun& run) { return !run.failure.empty(); });
  if (!study.runs.empty()) {
    add(table.data, "simulations",
        fmt::format("{}, of which {} failed", study.runs.size(), failed));
  }
  chapter.blocks.push_back(std::move(table));
  return chapter;
}

Chapter limits_chapter(const StudyResult& result) {
  Chapter chapter{.id = "limits", .title = "Limitations and warnings", .blocks = {}};
  for (const std::string& warning : warnings_of(result)) {
    chapter.blocks.push_back(Remark{shortened(warning, 1500)});
  }
  std::vector<const char*> limits = {
      "An interval is what these measurements allow if the model is right: it does not include "
      "errors of the contact model, the clump's shape or the bench procedure."};
  if (result.provenance.model) {
    chapter.blocks.push_back(
        Remark{"Budget: " + shortened(result.provenance.study.budget_description, 1000) + "."});
    limits.push_back(
        "Coefficients calibrated at reduced stiffness are valid only at that stiffness.");
  } else {
    limits.push_back(
        "Between the rows of the table a smooth surface stands for the program that made them: "
        "nothing was simulated to check it.");
  }
  if (has_heap(result)) {
    limits.push_back(
        "A heap's angle hardly depends on restitution, and constrains only a combination of "
        "sliding "
        "and rolling friction between grains.");
  }
  for (const char* text : limits) chapter.blocks.push_back(Paragraph{text});
  return chapter;
}

namespace {

/// Replaces "mu_r F_n" in the definition's plain text by symbols.
std::string rolling_text(std::string definition) {
  for (const auto& [plain, sign] : {std::pair("mu_r", "μᵣ"), {"F_n", "Fₙ"}}) {
    const std::string_view word = plain;
    for (std::size_t at = definition.find(word); at != std::string::npos;
         at = definition.find(word)) {
      definition.replace(at, word.size(), sign);
    }
  }
  return definition;
}

/// Escaped, so that nothing in a name is a command.
std::string latex_text(const std::string& text) {
  static const std::map<std::string, std::string> kSpelled = {{"\\", "\\textbackslash{}"},
                                                              {"%", "\\%"},
                                                              {"_", "\\_"},
                                                              {"#", "\\#"},
                                                              {"&", "\\&"},
                                                              {"$", "\\$"},
                                                              {"{", "\\{"},
                                                              {"}", "\\}"},
                                                              {"^", "\\^{}"},
                                                              {"~", "\\~{}"}};
  static const std::array<std::pair<std::string, std::string>, 20> kSigns = {
      {{"χ²", "$\\chi^2$"}, {"T²", "$T^2$"}, {"μₛ", "$\\mu_s$"}, {"μᵣ", "$\\mu_r$"},
       {"fᵢ", "$f_i$"},     {"vᵢ", "$v_i$"}, {"mᵢ", "$m_i$"},    {"sᵢ", "$s_i$"},
       {"nᵢ", "$n_i$"},     {"xⱼ", "$x_j$"}, {"Fₙ", "$F_n$"},    {"é", "\\'e"},
       {"ä", "\\\"a"},      {"μ", "$\\mu$"}, {"σ", "$\\sigma$"}, {"°", "$^\\circ$"},
       {"×", "$\\times$"},  {"±", "$\\pm$"}, {"–", "--"},        {"−", "$-$"}}};
  std::string escaped;
  for (const char letter : text) {
    const auto spelled = kSpelled.find(std::string(1, letter));
    escaped += spelled == kSpelled.end() ? std::string(1, letter) : spelled->second;
  }
  for (const auto& [sign, command] : kSigns) {
    for (std::size_t at = escaped.find(sign); at != std::string::npos;
         at = escaped.find(sign, at + command.size())) {
      escaped.replace(at, sign.size(), command);
    }
  }
  return escaped;
}

/// Paragraphs and equations, as text and as LaTeX.
struct Methods {
  std::vector<Block> blocks;
  std::string latex;

  void add(std::string_view text) {
    blocks.push_back(Paragraph{std::string(text)});
    latex += latex_text(std::string(text)) + '\n';
  }
  void add_equation(std::string_view text, std::string_view in_latex) {
    blocks.push_back(Equation{std::string(text)});
    latex += fmt::format("\\begin{{equation}}\n  {}\n\\end{{equation}}\n", in_latex);
  }
};

std::string stiffness_text(const ModelFacts& model) {
  std::string text;
  for (const auto& [experiment, factor] : model.stiffness_factor) {
    if (!text.empty()) text += ", ";
    text += shortened(experiment) + ' ' + shown(factor);
  }
  return text;
}

void add_simulation(const Provenance& provenance, Methods& methods) {
  if (provenance.table && provenance.table->engine) {
    const EngineFacts& engine = *provenance.table->engine;
    methods.add(fmt::format(
        "{} simulations were made by the command \"{}\" at places that {} chose round by round, "
        "where they narrow the answer most{}; {} of them failed.",
        engine.runs, shortened(engine.command, 300), provenance.study.program,
        provenance.table->rows > engine.runs ? ", and others were given to it as a table" : "",
        engine.failed));
    return;
  }
  if (provenance.table) {
    methods.add(fmt::format(
        "{} simulations, or means of several with other seeds, were made with another program at "
        "places that its user chose, and given to {} as a table of parameters and readings.",
        provenance.table->rows, provenance.study.program));
    return;
  }
  const ModelFacts& model = *provenance.model;
  const ClumpFacts& clump = model.clump;
  methods.add(fmt::format(
      "Grains were simulated with the discrete element method ({}) as clumps of {} "
      "overlapping spheres ({}; volume error {} %, inertia error {} %); volume, mass "
      "and inertia are those of the surface.{} Contacts follow {}: with overlap d of "
      "two surfaces,",
      provenance.study.program, clump.spheres, shortened(clump.source, 300),
      shown(100 * clump.volume_error, 2), shown(100 * clump.inertia_error, 2),
      clump.size_sd_percent ? fmt::format(" Sizes of the grains in bulks vary normally, with a "
                                          "standard deviation of {} %.",
                                          shown(clump.size_sd_percent))
                            : "",
      model.contact_model));
  methods.add_equation(
      "Fₙ = (4/3) E* √R* d^(3/2),   1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂,   1/R* = 1/R₁ + "
      "1/R₂,  |Fₜ| ≤ μₛ Fₙ",
      "F_n = \\tfrac43 E^* \\sqrt{R^*}\\, d^{3/2}, \\quad "
      "\\frac{1}{E^*} = \\frac{1-\\nu_1^2}{E_1} + \\frac{1-\\nu_2^2}{E_2}, \\quad "
      "\\frac{1}{R^*} = \\frac{1}{R_1} + \\frac{1}{R_2}, \\quad "
      "|F_t| \\le \\mu_s F_n");
  methods.add(fmt::format(
      "with damping that gives the stated coefficient of restitution in a central impact of two "
      "spheres ({}), and sliding friction μₛ. Rolling friction μᵣ: {}. Young's moduli were "
      "multiplied by these factors: {}.",
      shortened(model.damping_definition, 400),
      shortened(rolling_text(model.rolling_definition), 400), stiffness_text(model)));
}

std::string seen_in(const ReportedStudy& study) {
  if (study.pictures.empty()) return "";
  const auto is_scan = [](const PictureReading& picture) {
    return vision::has_scan_ending(picture.file);
  };
  return std::ranges::any_of(study.pictures, is_scan) ? "silhouettes of scans" : "photographs";
}

/// @param bench  medium in which the bench's heaps were seen; empty: their angles were given
void add_angle(const std::string& bench, Methods& methods) {
  methods.add(fmt::format(
      "The angle of repose was measured in {}silhouettes of the simulated heaps{}: on each side a "
      "straight line was fitted to the heap's edge between 20 and 80 % of its height, and the "
      "angle is the mean of both sides' angles to the ground line,",
      bench.empty() ? "" : bench + " and in ", bench.empty() ? "" : " by the same program"));
  methods.add_equation("θ = (θ_left + θ_right) / 2",
                       "\\theta = \\tfrac12 (\\theta_\\mathrm{left} + \\theta_\\mathrm{right})");
}

/// How the fit's simulations were placed, round by round.
std::string runs_text(const JointResult& joint) {
  if (joint.is_of_table) return "The simulations are those of the table.";
  const auto all = static_cast<int>(joint.runs.size());
  const std::string made = fmt::format("{} simulations entered the fit", all);
  // Rounds count all runs planned so far; the checks' runs follow.
  if (joint.rounds.empty() || joint.rounds.back().jobs > all) return made + '.';
  const int spread = joint.rounds.front().jobs;
  const int placed = joint.rounds.back().jobs - spread;
  const int checks = all - spread - placed;
  std::string text = fmt::format("{}: {} were spread over the bounds", made, spread);
  if (placed > 0) {
    text += fmt::format(
        "; {} more, in {} further round{}, were made at coefficients that those "
        "before left plausible or little known",
        placed, joint.rounds.size() - 1, joint.rounds.size() == 2 ? "" : "s");
  }
  if (checks > 0) {
    text +=
        fmt::format("; {} checked the best fits and equally good sets with fresh seeds", checks);
  }
  return text + '.';
}

void add_joint_fit(const JointResult& joint, Methods& methods) {
  methods.add(fmt::format(
      "All {} coefficients were fitted to all {} measured means at once. {} Each measured "
      "quantity was described by a Gaussian process with expectation fᵢ and variance vᵢ (Matérn "
      "5/2, seed noise included), and the coefficients x minimise",
      joint.parameters.size(), joint.observables.size(), runs_text(joint)));
  methods.add_equation(
      "χ²(x) = Σᵢ (fᵢ(x) − mᵢ)² / (uᵢ² + vᵢ(x)),  uᵢ = (sᵢ/√nᵢ) · t(0.975; nᵢ−1)/1.960",
      "\\chi^2(x) = \\sum_i \\frac{(f_i(x)-m_i)^2}{u_i^2+v_i(x)}, \\quad "
      "u_i = \\frac{s_i}{\\sqrt{n_i}}\\,\\frac{t_{.975,\\,n_i-1}}{1.960}");
  methods.add(
      std::string("where mᵢ, sᵢ and nᵢ are mean, standard deviation and number of the bench's "
                  "readings, and t is Student's quantile") +
      (!joint.is_of_table
           ? ". Readings of one experiment enter with the covariance of runs with other seeds at "
             "the same place, as far as these explain the bench's scatter (shrunk: Schäfer and "
             "Strimmer 2005)."
           : ", or 1.960 where the scatter is known beforehand.") +
      " Intervals are 95 % profile-likelihood intervals (Venzon and Moolgavkar 1988), the values "
      "xⱼ "
      "for which");
  methods.add_equation("min χ²(x | xⱼ) ≤ min χ²(x) + t²(0.975; νⱼ) wⱼ/Cⱼ",
                       "\\min_{x:\\,x_j\\ \\mathrm{fixed}} \\chi^2(x) \\le \\min_x \\chi^2(x) + "
                       "t^2_{.975,\\,\\nu_j}\\,w_j/C_j");
  methods.add(
      "where, with the fit linearised at its minimum, Cⱼ is the variance of xⱼ by these uᵢ, wⱼ the "
      "one by sᵢ/√nᵢ with what estimated weights add to it (Kenward and Roger 1997), and νⱼ its "
      "effective degrees of freedom (Welch and Satterthwaite: GUM G.4.1). Where scatters are known "
      "the limit is 3.84. A coefficient is called determined when both ends of its interval lie "
      "inside the bounds and "
      "its half-width is at most 25 % of the value or what the study calls useful, bounded when "
      "the "
      "interval is wider, one-sided when one end lies inside, undetermined otherwise.");
  if (!joint.verdict) {
    methods.add("The fitted parameters were not simulated to check them.");
    return;
  }
  methods.add(
      fmt::format("The best fit was simulated again with fresh seeds{}. ",
                  joint.is_of_table ? ", in runs that had no part in it"
                                    : ", and all of these runs entered the fit") +
      "Simulated and measured means were compared by "
      "Welch's t (several of one experiment by Hotelling's T²), over all experiments by the sum of "
      "the chi-squares with the same probabilities (Lancaster 1961), whose distribution takes "
      "account of what the fit could follow (Box 1954), and for equivalence by two "
      "one-sided tests at 5 % (Schuirmann 1987).");
}

void add_paper_way(Methods& methods) {
  methods.add(
      "The particle–wall coefficients were found one after the other: each was swept over nine "
      "levels, and a parabola was fitted to the results and solved for the measured value. Those "
      "between grains were approached by steepest ascent and refined by a central composite "
      "design, and a quadratic surface was fitted to its relative errors of the angle:");
  methods.add_equation("|θ − θ_measured| / θ_measured = b₀ + Σ bᵢxᵢ + Σ bᵢⱼxᵢxⱼ + Σ bᵢᵢxᵢ²",
                       "\\frac{|\\theta-\\theta_m|}{\\theta_m} = b_0 + \\sum_i b_i x_i + "
                       "\\sum_{i<j} b_{ij} x_i x_j + \\sum_i b_{ii} x_i^2");
  methods.add("Its minimum within the design's box was simulated ten times.");
}

}  // namespace

Chapter methods_chapter(const ReportedStudy& study, const StudyResult& result) {
  Methods methods;
  add_simulation(result.provenance, methods);
  if (has_heap(result)) add_angle(seen_in(study), methods);
  if (const auto* joint = std::get_if<JointResult>(&result.found)) {
    add_joint_fit(*joint, methods);
  } else {
    add_paper_way(methods);
  }
  Chapter chapter{
      .id = "methods", .title = "Methods paragraph", .blocks = std::move(methods.blocks)};
  chapter.blocks.push_back(CodeText{.label = "As LaTeX", .text = methods.latex});
  return chapter;
}

}  // namespace repose::calibrate::report
