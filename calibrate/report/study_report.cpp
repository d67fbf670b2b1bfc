#include "calibrate/report/study_report.h"

#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/file_set.h"
#include "base/version.h"
#include "calibrate/report/chapters.h"
#include "calibrate/report/page.h"
#include "calibrate/report/report_of.h"
#include "calibrate/report/wording.h"
#include "calibrate/study/study_record.h"

namespace repose::calibrate::report {
namespace {

void add(std::vector<Chapter> more, bool is_appendix, std::vector<Chapter>& chapters) {
  for (Chapter& chapter : more) {
    chapter.is_appendix = is_appendix;
    chapters.push_back(std::move(chapter));
  }
}

/// The answer and its evidence, then what is needed to check it.
std::vector<Chapter> finished_chapters(const ReportedStudy& study, const StudyResult& result) {
  const HeapPictures pictures = heap_pictures(study);
  std::vector<Chapter> chapters;
  if (const auto* joint = std::get_if<JointResult>(&result.found)) {
    add({answer_chapter(*joint, pictures), protocol_chapter(study), table_chapter(result),
         heap_chapter(pictures), agreement_chapter(*joint), assumed_chapter(*joint),
         sensitivity_chapter(study, *joint), limits_chapter(result)},
        false, chapters);
    add({more_heaps_chapter(pictures), checks_chapter(*joint), curves_chapter(study, *joint),
         surfaces_chapter(study, *joint), knowledge_chapter(*joint), statistics_chapter(*joint),
         convergence_chapter(*joint)},
        true, chapters);
  } else {
    add(paper_chapters(std::get<PublishedResult>(result.found), pictures), false, chapters);
    add({protocol_chapter(study), limits_chapter(result)}, false, chapters);
    add({more_heaps_chapter(pictures)}, true, chapters);
  }
  add({methods_chapter(study, result), provenance_chapter(study)}, true, chapters);
  return chapters;
}

Document document_of(const ReportedStudy& study) {
  Document document{
      .title = shortened(study.study ? study.study->file : study.folder.filename().string()),
      .kind = "Calibration of contact coefficients",
      .state = {},
      .chapters = {},
      .program = base::kProgram};
  std::vector<Chapter> chapters;
  if (study.result) {
    if (is_provisional(*study.result)) {
      document.state =
          fmt::format("Provisional: {}. This is what is known so far, not a final result.",
                      std::get<JointResult>(study.result->found).provisional);
    }
    chapters = finished_chapters(study, *study.result);
  } else {
    document.state = "Unfinished: this study has no result yet.";
    chapters = unfinished_chapters(study);
    add({protocol_chapter(study)}, false, chapters);
    if (!study.pictures.empty()) {
      const HeapPictures pictures = heap_pictures(study);
      add({heap_chapter(pictures)}, false, chapters);
      add({more_heaps_chapter(pictures)}, true, chapters);
    }
    if (study.study) add({provenance_chapter(study)}, true, chapters);
  }
  for (Chapter& chapter : chapters) {
    if (!chapter.blocks.empty()) document.chapters.push_back(std::move(chapter));
  }
  return document;
}

/// At the top: the study's own title, author, date and note.
void put_heading(const ReportedStudy& study, Document& document) {
  constexpr std::size_t kLongest = 1000;
  const dem::StudyHeading& heading = study.heading;
  if (!heading.title.empty()) document.title = shortened(heading.title);
  if (document.chapters.empty()) return;
  std::string line = shortened(heading.author);
  if (!heading.date.empty()) line += (line.empty() ? "" : ", ") + shortened(heading.date);
  std::vector<Block> blocks;
  if (!line.empty()) blocks.emplace_back(Paragraph{line + '.'});
  if (!heading.note.empty()) blocks.emplace_back(Paragraph{shortened(heading.note, kLongest)});
  auto& first = document.chapters.front().blocks;
  first.insert(first.begin(), blocks.begin(), blocks.end());
}

/// Duplicate names, such as shortened ones, get a number.
void number_alike(Document& document) {
  std::set<std::string> taken;
  const auto number = [&](std::string& name) {
    if (name.empty()) return;
    const std::string first = name;
    for (int k = 2; !taken.insert(name).second; ++k) name = fmt::format("{}_{}", first, k);
  };
  for (Chapter& chapter : document.chapters) {
    for (Block& block : chapter.blocks) {
      if (auto* table = std::get_if<Table>(&block)) number(table->name);
      if (auto* row = std::get_if<ChartRow>(&block)) {
        for (Chart& chart : row->charts) number(chart.name);
      }
    }
  }
}

}  // namespace

Report report_of(Document document) {
  number_alike(document);
  Report report{.html = html_of(document), .tables = {}};
  for (const NamedTable& table : tables_of(document)) {
    report.tables.push_back({.name = table.name + ".csv", .text = csv_of(*table.data)});
  }
  return report;
}

Report study_report(const StudyResult& result, const std::vector<PictureReading>& pictures,
                    const std::filesystem::path& heap) {
  return report_of(document_of(reported(result, pictures, heap)));
}

Report study_report(const std::filesystem::path& folder) {
  const ReportedStudy study = read_reported_study(folder);
  Document document = document_of(study);
  put_heading(study, document);
  return report_of(std::move(document));
}

void write_report(const Report& report, const std::filesystem::path& page,
                  const std::filesystem::path& tables, bool is_ours) {
  if (!tables.empty()) {
    std::vector<base::NamedText> files;
    for (const CsvFile& table : report.tables) files.push_back({table.name, table.text});
    base::write_file_set(tables, files, is_ours ? base::Unlisted::ours : base::Unlisted::users);
  }
  base::write_whole_file(page, report.html);
}

std::filesystem::path write_report(const std::filesystem::path& folder) {
  const Report report = study_report(folder);
  std::filesystem::path page = folder / "report.html";
  const auto earlier = base::read_file_if_there(page);
  if (earlier && !earlier->empty() && earlier->find(kPageMark) == std::string::npos) {
    base::refuse(page, "already exists, and is no report of repose", "move it away.");
  }
  write_report(report, page, folder / "tables", true);
  return page;
}

}  // namespace repose::calibrate::report
