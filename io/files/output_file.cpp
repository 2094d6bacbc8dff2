#include "io/files/output_file.h"

#include <zlib.h>

#include <QFile>
#include <QFileInfo>
#include <QSaveFile>
#include <algorithm>
#include <array>
#include <cerrno>

namespace volumen {

struct OutputFile::State {
  std::string path;
  QSaveFile file;
  bool gzip = false;
  z_stream stream{};
  std::array<Bytef, 1 << 16> packed{};

  explicit State(const std::string& name)
      : path(name), file(QFile::decodeName(QByteArray::fromStdString(name))) {}
  ~State() {
    if (gzip) deflateEnd(&stream);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

OutputFile::OutputFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile::~OutputFile() = default;

Status OutputFile::fail(const std::string& why) const {
  return Error{"Cannot write " + state_->path + ": " + why + "."};
}

namespace {

// Why Qt could not make a file aside of `path`.
std::string whyNot(const QString& path, const QString& error) {
  const QFileInfo file(path), folder(file.absolutePath());
  if (file.isDir()) return "it is a folder";
  if (!folder.isDir() || error == qt_error_string(ENOENT)) return "no such folder";
  if (!folder.isWritable() || (file.exists() && !file.isWritable())) return "no permission to write there";
  return error.left(1).toLower().toStdString() + error.mid(1).toStdString();
}

}  // namespace

Result<OutputFile> OutputFile::create(const std::string& path) {
  OutputFile out(std::make_unique<State>(path));
  QSaveFile& file = out.state_->file;
  if (!file.open(QIODevice::WriteOnly)) return out.fail(whyNot(file.fileName(), file.errorString())).error();
  return out;
}

Status OutputFile::startGzip() {
  constexpr int level = 4, gzipWindow = 15 + 16, memory = 8;  // level 4: near 6's size at twice its speed
  z_stream& stream = state_->stream;
  if (deflateInit2(&stream, level, Z_DEFLATED, gzipWindow, memory, Z_DEFAULT_STRATEGY) != Z_OK)
    return fail("not enough memory to compress");
  state_->gzip = true;
  return {};
}

// Compresses what the stream's input holds and writes what comes out.
Status OutputFile::deflateAll(int flush) {
  z_stream& stream = state_->stream;
  int code = Z_OK;
  do {
    stream.next_out = state_->packed.data();
    stream.avail_out = uInt(state_->packed.size());
    code = deflate(&stream, flush);
    const qint64 count = qint64(state_->packed.size() - stream.avail_out);
    if (state_->file.write(reinterpret_cast<const char*>(state_->packed.data()), count) != count)
      return fail(state_->file.errorString().toStdString());
  } while (stream.avail_out == 0 || (flush == Z_FINISH && code == Z_OK));
  return {};
}

Status OutputFile::write(const void* bytes, std::size_t count) {
  if (!state_->gzip) {
    if (state_->file.write(static_cast<const char*>(bytes), qint64(count)) != qint64(count))
      return fail(state_->file.errorString().toStdString());
    return {};
  }
  const auto* next = static_cast<const Bytef*>(bytes);
  while (count > 0) {
    constexpr std::size_t most = 1u << 30;  // zlib counts in unsigned int
    const std::size_t part = std::min(count, most);
    state_->stream.next_in = const_cast<Bytef*>(next);  // zlib only reads it
    state_->stream.avail_in = uInt(part);
    if (Status s = deflateAll(Z_NO_FLUSH); !s) return s;
    next += part;
    count -= part;
  }
  return {};
}

Status OutputFile::commit() {
  if (state_->gzip)
    if (Status s = deflateAll(Z_FINISH); !s) return s;
  if (!state_->file.commit()) return fail(state_->file.errorString().toStdString());
  return {};
}

QIODevice& OutputFile::device() { return state_->file; }

}  // namespace volumen
