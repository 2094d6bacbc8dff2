#include "app/report_files.h"

#include <QDate>
#include <QGuiApplication>
#include <filesystem>
#include <iostream>

#include "app/command.h"
#include "io/files/output_file.h"

namespace volumen {

namespace {

template <class Write>
Status writeWhole(const std::string& folder, const char* name, Write write) {
  const std::string path = (std::filesystem::path(folder) / name).string();
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  if (Status s = write(*file); !s) return s;
  if (Status s = file->commit(); !s) return s;
  std::cout << printable(path) << '\n';
  return {};
}

}  // namespace

Status makeFolder(const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Error{folder + ": the folder cannot be made (" + failed.message() + ")."};
  return {};
}

Status writeReport(const std::string& folder, const char* name, const std::string& text) {
  return writeWhole(folder, name, [&](OutputFile& file) { return file.write(text); });
}

Status writeReport(const std::string& folder, const char* name, const QImage& picture) {
  return writeWhole(folder, name, [&](OutputFile& file) -> Status {
    if (picture.save(&file.device(), "PNG")) return {};
    return Error{folder + "/" + name + ": the picture cannot be written."};
  });
}

StudyTitle titleOf(const std::string& volume, const std::string& scene) {
  return {volume, scene, machineName(), QDate::currentDate().toString(Qt::ISODate).toStdString()};
}

void prepareFonts() {
  qputenv("QT_QPA_PLATFORM", "offscreen");
  static int argc = 1;
  static char name[] = "volumen";
  static char* argv[] = {name, nullptr};
  // Qt says that there is no folder for sockets of a session, which nobody needs here.
  const QtMessageHandler before =
      qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
  static const QGuiApplication application(argc, argv);
  qInstallMessageHandler(before);
}

}  // namespace volumen
