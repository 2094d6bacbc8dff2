#include "app/report_files.h"

#include <QDate>
#include <QGuiApplication>
#include <filesystem>
#include <iostream>

#include "app/command.h"
#include "io/files/output_file.h"
#include "io/files/picture_file.h"
#include "results/pictures/picture_font.h"

namespace volumen {

namespace {

namespace fs = std::filesystem;

}  // namespace

Status checkFolder(const std::string& folder) {
  std::vector<fs::path> made;
  std::error_code ignored;
  for (fs::path at = fs::path(folder).lexically_normal(); !at.empty() && !fs::exists(at, ignored);
       at = at.parent_path())
    made.push_back(at);
  Status status = makeFolder(folder);
  if (status)
    if (auto file = OutputFile::create((fs::path(folder) / "study.csv").string()); !file)
      status = file.error();
  for (const fs::path& empty : made) fs::remove(empty, ignored);
  return status;
}

Status makeFolder(const std::string& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  const bool there = fs::is_directory(folder, failed);
  if (there) return {};
  return Error{
      "Cannot make the folder " + folder + ": " +
      (fs::exists(folder, failed) ? "a file has this name" : "no permission, or not a place for one") + "."};
}

Status writeReport(const std::string& folder, const char* name, const std::string& text) {
  const std::string path = (fs::path(folder) / name).string();
  if (Status s = writeWholeFile(path, text); !s) return s;
  std::cout << printable(path) << '\n';
  return {};
}

Status writeReport(const std::string& folder, const char* name, const QImage& picture) {
  const std::string path = (fs::path(folder) / name).string();
  if (Status written = writeImage(picture, path, {}); !written) return written;
  std::cout << printable(path) << '\n';
  return {};
}

StudyTitle titleOf(const std::string& volume, const std::string& scene) {
  return {volume, scene, machineName(), QDate::currentDate().toString(Qt::ISODate).toStdString()};
}

void prepareFonts() {
  qputenv("QT_QPA_PLATFORM", "offscreen");
  static int argc = 1;
  static char name[] = "volumen";
  static char* argv[] = {name, nullptr};
  // Qt warns of a missing folder for sockets, which is not needed here.
  const QtMessageHandler before =
      qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
  // Never destroyed: at program end Qt's fonts are destroyed first.
  [[maybe_unused]] static const auto* const application = new QGuiApplication(argc, argv);
  qInstallMessageHandler(before);
  QGuiApplication::setFont(pictureFont());
}

}  // namespace volumen
