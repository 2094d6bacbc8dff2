#include "app/index_option.h"

#include <filesystem>

namespace volumen {

std::string indexFolderOr(const std::string& folder) { return folder.empty() ? userIndexFolder() : folder; }

void addIndex(CLI::App& app, std::string& folder) {
  app.add_option("--index", folder, "The folder of the index; else $XDG_DATA_HOME/volumen")
      ->type_name("FOLDER");
}

Result<Index> openExistingIndex(const std::string& folder) {
  std::error_code ignored;
  if (!folder.empty() && !std::filesystem::exists(folder + "/index.sqlite", ignored))
    return Error{"There is no index in " + folder + ": `volumen import PATH --index " + folder +
                 "` makes one."};
  return Index::openAsItIs(indexFolderOr(folder));
}

std::string copiesFolder(const std::string& indexFolder) { return indexFolderOr(indexFolder) + "/studies"; }

}  // namespace volumen
