#include "io/zip_entries.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <vector>

#include "io/regular_file.h"
#include "io/worker/call.h"

namespace volumen {
namespace worker {

template <>
inline constexpr ArchiveEntry::Kind lastOf<ArchiveEntry::Kind> = ArchiveEntry::Kind::other;

void fields(Wire& w, ArchiveEntry& e) { w(e.name, e.kind); }

}  // namespace worker

namespace {

constexpr std::size_t blockBytes = 1 << 18;

struct ArchiveCloser {
  void operator()(archive* a) const { archive_read_free(a); }
};

// Reads with libarchive from an open file.
class LocalEntries : public ArchiveEntries {
 public:
  explicit LocalEntries(const std::string& path)
      : file_(RegularFile::open(path)), reader_(archive_read_new()) {}

  Result<std::optional<ArchiveEntry>> next() override {
    if (!opened_ && !open()) return damaged();
    opened_ = true;
    archive_entry* entry = nullptr;
    const int code = archive_read_next_header(reader_.get(), &entry);
    if (code == ARCHIVE_EOF) return std::optional<ArchiveEntry>();
    if (code != ARCHIVE_OK && code != ARCHIVE_WARN) return damaged();
    if (archive_entry_is_encrypted(entry)) return Error{"is encrypted: unpack it with its password"};
    const char* name = archive_entry_pathname(entry);
    const auto type = archive_entry_filetype(entry);
    ArchiveEntry found{name ? name : "", ArchiveEntry::Kind::other};
    if (type == AE_IFDIR) found.kind = ArchiveEntry::Kind::folder;
    if (type == AE_IFREG && !archive_entry_hardlink(entry)) found.kind = ArchiveEntry::Kind::file;
    return std::optional(found);
  }

  Result<std::size_t> read(void* to, std::size_t count) override {
    const la_ssize_t got = archive_read_data(reader_.get(), to, count);
    if (got < 0) return damaged();
    return std::size_t(got);
  }

 private:
  bool open() {
    archive* a = reader_.get();
    return file_ && a && archive_read_support_format_zip(a) == ARCHIVE_OK &&
           archive_read_set_callback_data(a, this) == ARCHIVE_OK &&
           archive_read_set_read_callback(a, readBlock) == ARCHIVE_OK &&
           archive_read_set_seek_callback(a, seek) == ARCHIVE_OK &&
           archive_read_set_skip_callback(a, skip) == ARCHIVE_OK && archive_read_open1(a) == ARCHIVE_OK;
  }
  Error damaged() const {
    const char* why = reader_ ? archive_error_string(reader_.get()) : nullptr;
    if (!file_) why = file_.message().c_str();
    return Error{"cannot be unpacked" + (why ? std::string(": ") + why : std::string())};
  }

  static la_ssize_t readBlock(archive* a, void* self, const void** block) {
    auto& entries = *static_cast<LocalEntries*>(self);
    const Result<std::size_t> got = entries.file_->readAt(entries.at_, entries.block_.data(), blockBytes);
    if (!got) {
      archive_set_error(a, EIO, "%s", got.message().c_str());
      return ARCHIVE_FATAL;
    }
    entries.at_ += *got;
    *block = entries.block_.data();
    return la_ssize_t(*got);
  }
  static la_int64_t skip(archive*, void* self, la_int64_t count) {
    auto& entries = *static_cast<LocalEntries*>(self);
    const std::uint64_t left = entries.file_->size() - std::min(entries.at_, entries.file_->size());
    const std::uint64_t skipped = std::min(left, std::uint64_t(std::max<la_int64_t>(0, count)));
    entries.at_ += skipped;
    return la_int64_t(skipped);
  }
  static la_int64_t seek(archive*, void* self, la_int64_t offset, int from) {
    auto& entries = *static_cast<LocalEntries*>(self);
    const auto base = from == SEEK_CUR ? entries.at_ : from == SEEK_END ? entries.file_->size() : 0;
    entries.at_ = std::uint64_t(std::max<la_int64_t>(0, la_int64_t(base) + offset));
    return la_int64_t(entries.at_);
  }

  Result<RegularFile> file_;
  std::vector<std::uint8_t> block_ = std::vector<std::uint8_t>(blockBytes);
  std::uint64_t at_ = 0;
  bool opened_ = false;
  std::unique_ptr<archive, ArchiveCloser> reader_;  // destroyed before its input
};

// Announces a worker's next entry or block.
enum class Step { entry, end, problem };

}  // namespace

namespace worker {

template <>
inline constexpr Step lastOf<Step> = Step::problem;

}  // namespace worker

namespace {

constexpr std::uint64_t wrong = std::numeric_limits<std::uint64_t>::max();  // replaces a block's length

// Writes the blocks of a file after their lengths; 0 at the end, or `wrong` and the reason.
bool writeBlocks(worker::Wire& answer, LocalEntries& entries, std::vector<std::uint8_t>& block) {
  while (true) {
    const Result<std::size_t> got = entries.read(block.data(), block.size());
    if (!got) {
      answer.write(wrong, got.message());
      return false;
    }
    answer.write(std::uint64_t(*got));
    if (*got == 0) return true;
    answer.bytes(block.data(), *got);
  }
}

void writeEntries(worker::Wire& answer, const std::string& path) {
  LocalEntries entries(path);
  std::vector<std::uint8_t> block(blockBytes);
  while (true) {
    const auto entry = entries.next();
    if (!entry) return answer.write(Step::problem, entry.message());
    if (!*entry) return answer.write(Step::end);
    answer.write(Step::entry, **entry);
    if ((*entry)->kind == ArchiveEntry::Kind::file && !writeBlocks(answer, entries, block)) return;
  }
}

bool countBeyond(const std::string& path, std::uint64_t most) {
  LocalEntries entries(path);
  for (std::uint64_t count = 0; count <= most; ++count)
    if (const auto entry = entries.next(); !entry || !*entry) return false;
  return true;
}

// Reads the output of writeEntries().
class IsolatedEntries : public ArchiveEntries {
 public:
  IsolatedEntries(const std::string& path, const CancelToken& cancel)
      : cancel_(cancel),
        request_{.files = {path}, .mostBytes = wrong, .cancel = &cancel_},
        call_(worker::isolatedStream<writeEntries>(request_, path)) {}

  Result<std::optional<ArchiveEntry>> next() override {
    std::vector<std::uint8_t> waste(inFile_ ? blockBytes : 0);
    while (inFile_)
      if (const auto got = read(waste.data(), waste.size()); !got) return got.error();
    Step step{};
    (*call_)(step);
    if (step == Step::problem) return problem();
    ArchiveEntry entry;
    if (step == Step::entry) (*call_)(entry);
    if (!call_->ok()) return problem();
    inFile_ = step == Step::entry && entry.kind == ArchiveEntry::Kind::file;
    if (step == Step::end) return std::optional<ArchiveEntry>();
    return std::optional(entry);
  }

  Result<std::size_t> read(void* to, std::size_t count) override {
    if (left_ == 0 && inFile_) (*call_)(left_);
    if (left_ == wrong) return problem();
    inFile_ = inFile_ && left_ > 0;
    const std::size_t part = std::min<std::uint64_t>(left_, count);
    call_->bytes(to, part);
    left_ -= part;
    if (!call_->ok()) return problem();
    return part;
  }

 private:
  Error problem() {
    std::string sentence;
    left_ = 0, inFile_ = false;
    if (call_->ok()) (*call_)(sentence);
    if (call_->ok()) return Error{sentence};
    return Error{"cannot be unpacked: " + reasonOf(call_->failure(), request_)};
  }

  CancelToken cancel_;
  worker::Request request_;
  std::unique_ptr<worker::Call> call_;
  std::uint64_t left_ = 0;
  bool inFile_ = false;
};

}  // namespace

bool hasMoreEntries(const std::string& path, std::size_t most, const CancelToken& cancel) {
  worker::Request request{.files = {path}, .cancel = &cancel};
  worker::Failure failure{};
  const auto more = worker::isolated<countBeyond>(request, failure, path, std::uint64_t(most));
  return more && *more;
}

std::unique_ptr<ArchiveEntries> readArchive(const std::string& path, const CancelToken& cancel) {
  if (worker::isolating()) return std::make_unique<IsolatedEntries>(path, cancel);
  return std::make_unique<LocalEntries>(path);
}

}  // namespace volumen
