#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/result/result.h"
#include "calibrate/result/result_fields.h"

namespace repose::calibrate {
namespace {

constexpr const char* kJoint = "joint";
constexpr const char* kPublished = "paper";

/// File names need not be UTF-8, but JSON must be.
std::string text_of(const Json& json) {
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// Checks the sizes of related lists, which chapters and charts rely on.
void check_sizes(const JointResult& joint) {
  const auto require = [](bool is_right, const std::string& place, const char* rule) {
    if (!is_right) JsonReader::refuse(place, rule);
  };
  for (std::size_t k = 0; k < joint.responses.size(); ++k) {
    const ResponseCurve& curve = joint.responses[k];
    const std::size_t points = curve.values.size();
    require(points > 0 && curve.simulated.size() == points && curve.uncertainty.size() == points &&
                curve.scatter.size() == points,
            fmt::format("responses[{}]", k), "its lists must be of the same length, and not empty");
  }
  for (std::size_t k = 0; k < joint.surfaces.size(); ++k) {
    const ResponseSurface& surface = joint.surfaces[k];
    bool is_right = surface.simulated.size() == surface.y.size();
    for (const auto& row : surface.simulated) is_right &= row.size() == surface.x.size();
    require(is_right, fmt::format("surfaces[{}].simulated", k),
            "must have a row for each y, of a number for each x");
  }
  require(joint.correlation.size() == joint.parameters.size(), "correlation",
          "must have a row for each parameter");
  for (const auto& row : joint.correlation) {
    require(row.size() == joint.parameters.size(), "correlation",
            "must have a column for each parameter");
  }
}

void check_sizes(const PublishedResult& published) {
  for (const PublishedSweep& sweep : published.sweeps) {
    if (sweep.levels.empty() || sweep.levels.size() != sweep.results.size()) {
      JsonReader::refuse("sweeps", "levels and results must be of the same length, and not empty");
    }
  }
}

StudyResult result_in(const Json& json) {
  NamesInUse names;
  JsonReader reader(json, "", names);
  StudyResult result;
  std::string& method = result.provenance.study.method;
  reader("method", method);
  if (method == kJoint) {
    auto& joint = result.found.emplace<JointResult>();
    joint_fields(reader, joint, result.provenance);
    joint.is_of_table = result.provenance.table.has_value();
    check_sizes(joint);
  } else if (method == kPublished) {
    auto& published = result.found.emplace<PublishedResult>();
    published_fields(reader, published, result.provenance);
    check_sizes(published);
  } else {
    JsonReader::refuse("method", fmt::format("\"{}\" must be joint or paper", method));
  }
  return result;
}

}  // namespace

std::string to_json(const SurfaceSummary& summary) {
  NamesInUse names;
  JsonWriter writer(names);
  fields(writer, summary);
  return text_of(writer.take());
}

std::string to_json(const StudyResult& result) {
  NamesInUse names;
  JsonWriter writer(names);
  if (const auto* joint = std::get_if<JointResult>(&result.found)) {
    writer("method", std::string(kJoint));
    joint_fields(writer, *joint, result.provenance);
  } else {
    writer("method", std::string(kPublished));
    published_fields(writer, std::get<PublishedResult>(result.found), result.provenance);
  }
  return text_of(writer.take());
}

bool operator==(const StudyResult& one, const StudyResult& other) {
  return to_json(one) == to_json(other);
}

std::string name_of(AgreementVerdict verdict) {
  for (const auto& [known, name] : kAgreementNames) {
    if (known == verdict) return std::string(name);
  }
  return {};
}

std::string name_of(Verdict verdict) {
  for (const auto& [known, name] : kVerdictNames) {
    if (known == verdict) return std::string(name);
  }
  return {};
}

std::string name_of(BoundsOrigin origin) {
  for (const auto& [known, name] : kBoundsNames) {
    if (known == origin) return std::string(name);
  }
  return {};
}

std::string name_of(MarginSource source) {
  for (const auto& [known, name] : kMarginNames) {
    if (known == source) return std::string(name);
  }
  return {};
}

StudyResult result_from_json(const std::string& json, const std::string& name) {
  std::string reason;
  try {
    return result_in(Json::parse(json));
  } catch (const Json::exception& error) {
    reason = error.what();
  } catch (const WrongField& error) {
    reason = error.what();
  }
  throw base::InputError(
      {.where = name,
       .value = fmt::format("is not a result of this version of repose calibrate ({})", reason),
       .fix = "repose calibrate with the same study and folder writes it anew; what was simulated "
              "is used again."});
}

std::optional<StudyResult> read_result(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "result.json";
  const std::optional<std::string> text = base::read_file_if_there(file);
  if (!text) return std::nullopt;
  return result_from_json(*text, file.string());
}

std::optional<StudyIdentity> study_in_result(const std::string& json) {
  try {
    const Json parsed = Json::parse(json);
    NamesInUse names;
    JsonReader reader(parsed, "", names);
    StudyIdentity study;
    reader("method", study.method);
    reader.object("provenance", [&](JsonReader& inner) { fields(inner, study); });
    return study;
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const WrongField&) {
    return std::nullopt;
  }
}

}  // namespace repose::calibrate
