#include "io/files/preset_files.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/files/output_file.h"

namespace volumen {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest = 4u << 20;  // bytes

// Returns a file name for a preset; characters with a meaning in paths or shells become %XX.
std::string fileNameOf(const std::string& name) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string file;
  for (const unsigned char c : name)
    if (std::isalnum(c) || c == '-' || c == '_' || c == ' ' || c >= 0x80)
      file += char(c);
    else
      file += {'%', digits[c >> 4], digits[c & 15]};
  return file + ".json";
}

}  // namespace

std::string configFolder() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  const fs::path base = config && *config == '/' ? fs::path(config) : fs::path(home ? home : "/") / ".config";
  return (base / "volumen").string();
}

std::string presetFolder() { return configFolder() + "/presets"; }

std::string protocolFolder() { return configFolder() + "/protocols"; }

std::vector<PresetFile> readPresetFiles(const std::string& folder) {
  std::vector<PresetFile> files;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    std::error_code failed;
    if (entry.path().extension() != ".json" || !entry.is_regular_file(failed) ||
        entry.file_size(failed) > largest || failed)
      continue;
    std::ifstream file(entry.path(), std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    files.push_back({entry.path().string(), text.str()});
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

Status writePresetFile(const std::string& name, const std::string& text, const std::string& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return Error{folder + " cannot be made: " + failed.message() + "."};
  return writeWholeFile((fs::path(folder) / fileNameOf(name)).string(), text);
}

Status deletePresetFile(const std::string& path) {
  std::error_code failed;
  fs::remove(path, failed);
  if (failed) return Error{path + " cannot be deleted: " + failed.message() + "."};
  return {};
}

}  // namespace volumen
