#include "app/send_files.h"

#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/command.h"
#include "app/printable.h"
#include "app/progress.h"

namespace volumen {

namespace {

constexpr const char* interrupted = "Interrupted; what was sent stays in the archive.";
constexpr std::string_view archivePrefix = "archive:";

nlohmann::ordered_json reasonsJson(const std::vector<Refused>& files) {
  auto list = nlohmann::ordered_json::array();
  for (const Refused& one : files) list.push_back({{"path", pathForJson(one.path)}, {"reason", one.reason}});
  return list;
}

}  // namespace

Result<SendReport> sendFiles(const Archive& archive, const std::vector<std::string>& files,
                             const CancelToken& cancel) {
  auto report = sendToArchive(archive, files, terminalProgress(), cancel);
  endTerminalProgress();
  if (!report) return cancel.cancelled() ? Error{interrupted} : report.error();
  if (report->instances == 0)
    return Error{"There is nothing to send: " +
                 (report->notDicom.empty() ? "no files were found." : report->notDicom.front().reason + ".")};
  return report;
}

nlohmann::ordered_json sentJson(const SendReport& report) {
  return {{"instances", report.instances},
          {"sent", report.sent},
          {"failed", reasonsJson(report.failed)},
          {"notDicom", reasonsJson(report.notDicom)}};
}

std::string sentText(const SendReport& report, const Archive& archive) {
  std::string text = "Sent " + std::to_string(report.sent) + " of " + std::to_string(report.instances) +
                     " instances to " + archive.name;
  if (const std::size_t others = report.notDicom.size(); others > 0)
    text += "; " + std::to_string(others) + (others == 1 ? " file holds none" : " files hold none");
  return text + '\n';
}

int tellSent(const SendReport& report, const CancelToken& cancel) {
  if (cancel.cancelled()) return fail(interrupted);
  std::set<std::string> reasons;
  for (const Refused& one : report.failed)
    if (reasons.insert(one.reason).second)
      std::cerr << "volumen: " << printable(one.path + ": " + one.reason) << '\n';
  return report.failed.empty() ? exitDone : report.sent > 0 ? exitLosses : exitFailed;
}

Result<OutputTarget> OutputTarget::of(const std::string& output) {
  OutputTarget target;
  target.output_ = output;
  if (!output.starts_with(archivePrefix)) return target;
  const std::string list = userArchivesFile();
  const auto archives = readArchives(list);
  if (!archives) return archives.error();
  const auto archive = archiveNamed(*archives, output.substr(archivePrefix.size()), list);
  if (!archive) return archive.error();
  target.archive_ = *archive;
  target.folder_ = std::make_unique<QTemporaryDir>();
  if (!target.folder_->isValid())
    return Error{"No temporary folder can be made: " + target.folder_->errorString().toStdString() + "."};
  return target;
}

std::string OutputTarget::path() const {
  return folder_ ? folder_->filePath(QStringLiteral("export.dcm")).toStdString() : output_;
}

std::string OutputTarget::told(std::string text) const {
  if (!folder_) return text;
  return replaced(replaced(std::move(text), path(), output_), folder_->path().toStdString(), output_);
}

}  // namespace volumen
