#include "app/index_option.h"

#include <filesystem>

#include "app/command.h"
#include "io/qt_application.h"

namespace volumen {

namespace {

const Error noHome{"There is no home folder to keep the index in: name one with --index FOLDER."};

}  // namespace

std::string indexFolderOr(const std::string& folder) { return folder.empty() ? userIndexFolder() : folder; }

void addIndex(CLI::App& app, std::string& folder) {
  app.add_option("--index", folder, "The folder of the index; else $XDG_DATA_HOME/volumen")
      ->type_name("FOLDER");
}

Result<Index> openIndex(const std::string& folder) {
  needQtApplication();
  const std::string at = indexFolderOr(folder);
  if (at.empty()) return noHome;
  return Index::open(at);
}

Result<Index> openExistingIndex(const std::string& folder) {
  needQtApplication();
  std::error_code ignored;
  if (!folder.empty() && !std::filesystem::exists(folder + "/index.sqlite", ignored))
    return Error{"There is no index in " + folder + ": `volumen import PATH --index " + folder +
                 "` makes one."};
  const std::string at = indexFolderOr(folder);
  return at.empty() ? Result<Index>(noHome) : Index::openAsItIs(at);
}

std::string copiesFolder(const std::string& indexFolder) { return indexFolderOr(indexFolder) + "/studies"; }

}  // namespace volumen
