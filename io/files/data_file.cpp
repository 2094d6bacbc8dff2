#include "io/files/data_file.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "io/worker/serve.h"

namespace volumen {

namespace fs = std::filesystem;

Result<DataFile> DataFile::open(const std::string& path) {
  Result<RegularFile> file = RegularFile::open(path);
  if (!file) return Error{path + " cannot be opened: " + file.error().message + "."};
  return DataFile(std::make_shared<const RegularFile>(std::move(*file)), path);
}

Result<std::size_t> DataFile::readAt(std::uint64_t offset, void* to, std::size_t count) const {
  const Result<std::size_t> done = file_->readAt(offset, to, count);
  if (!done) return Error{path_ + " cannot be read: " + done.error().message + "."};
  return *done;
}

Result<std::string> readHead(const std::string& path, std::size_t count) {
  auto file = DataFile::open(path);
  if (!file) return file.error();
  std::string head(std::min<std::uint64_t>(count, file->size()), '\0');
  auto got = file->readAt(0, head.data(), head.size());
  if (!got) return got.error();
  head.resize(*got);
  return head;
}

Result<std::string> resolveBeside(const std::string& headerPath, const std::string& name) {
  if (worker::inside()) return worker::resolveInside(headerPath, name);
  const std::string refers = headerPath + " refers to the data file '" + name.substr(0, 200) + "'";
  const Error outside{refers + "; only files in or below its own folder are read."};
  const fs::path relative(name);
  if (name.empty() || name.find('\0') != std::string::npos || relative.is_absolute()) return outside;
  std::error_code e;
  const fs::path folder = fs::canonical(fs::absolute(fs::path(headerPath), e).parent_path(), e);
  if (e) return Error{headerPath + " cannot be opened: " + e.message() + "."};
  const fs::path whole = fs::weakly_canonical(folder / relative, e);
  if (e) return Error{refers + ": " + e.message() + "."};
  const auto end = std::mismatch(folder.begin(), folder.end(), whole.begin(), whole.end());
  if (end.first != folder.end()) return outside;
  if (!fs::exists(whole, e)) return Error{refers + ", which is not there."};
  if (!fs::is_regular_file(whole, e)) return Error{refers + ", which is not a regular file."};
  if (fs::equivalent(whole, headerPath, e)) return Error{refers + ", which is the header itself."};
  return whole.string();
}

}  // namespace volumen
