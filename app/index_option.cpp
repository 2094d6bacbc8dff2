#include "app/index_option.h"

#include <QCoreApplication>
#include <filesystem>

#include "app/command.h"

namespace volumen {

namespace {

const Error noHome{"There is no home folder to keep the index in: name one with --index FOLDER."};

std::string folderOr(const std::string& folder) { return folder.empty() ? userIndexFolder() : folder; }

// Qt finds its SQLite driver only if there is an application.
void makeQtApplication() {
  static int argc = 1;
  static char name[] = "volumen";
  static char* argv[] = {name, nullptr};
  static const QCoreApplication application(argc, argv);
}

}  // namespace

void addIndex(CLI::App& app, std::string& folder) {
  app.add_option("--index", folder, "The folder of the index; else $XDG_DATA_HOME/volumen")
      ->type_name("FOLDER");
}

Result<Index> openIndex(const std::string& folder) {
  makeQtApplication();
  const std::string at = folderOr(folder);
  if (at.empty()) return noHome;
  return Index::open(at);
}

Result<Index> openExistingIndex(const std::string& folder) {
  makeQtApplication();
  std::error_code ignored;
  if (!folder.empty() && !std::filesystem::exists(folder + "/index.sqlite", ignored))
    return Error{"There is no index in " + folder + ": `volumen import PATH --index " + folder +
                 "` makes one."};
  const std::string at = folderOr(folder);
  return at.empty() ? Result<Index>(noHome) : Index::openAsItIs(at);
}

std::string copiesFolder(const std::string& indexFolder) { return folderOr(indexFolder) + "/studies"; }
std::string fetchedFolder(const std::string& indexFolder) { return folderOr(indexFolder) + "/fetched"; }

}  // namespace volumen
