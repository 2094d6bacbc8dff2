#include "io/deidentify/made_folder.h"

namespace volumen {

MadeFolder::MadeFolder(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, ignored); at = at.parent_path())
    missing_.push_back(at.has_filename() ? at : at.parent_path());
}

MadeFolder::~MadeFolder() {
  std::error_code ignored;
  for (const std::filesystem::path& folder : missing_) std::filesystem::remove(folder, ignored);
}

}  // namespace volumen
