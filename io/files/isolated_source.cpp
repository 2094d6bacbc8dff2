#include "io/files/isolated_source.h"

#include <algorithm>
#include <limits>

#include "io/files/text_source.h"
#include "io/worker/call.h"
#include "io/worker/file_fields.h"

namespace volumen {
namespace {

// The length before each block of bytes: 0 at the end, `wrong` before an error message.
constexpr std::uint64_t wrong = std::numeric_limits<std::uint64_t>::max();

void writeDecoded(worker::Wire& answer, const std::string& path, std::uint64_t offset, Encoding encoding,
                  const std::optional<TextSamples>& text) {
  auto file = DataFile::open(path);
  if (!file) return answer.write(wrong, file.message());
  const auto source =
      text ? decodeText(std::move(*file), offset, *text) : decode(std::move(*file), offset, encoding);
  std::vector<std::uint8_t> some(1 << 18);
  while (true) {
    const auto got = source->read(some.data(), some.size());
    if (!got) return answer.write(wrong, got.message());
    const std::uint64_t count = *got;
    answer.write(count);
    if (count == 0) return;
    answer.bytes(some.data(), count);
  }
}

class IsolatedSource : public ByteSource {
 public:
  IsolatedSource(const std::string& path, std::uint64_t offset, Encoding encoding,
                 const std::optional<TextSamples>& text, const CancelToken& cancel)
      : cancel_(cancel),
        request_{.files = {path}, .mostBytes = wrong, .cancel = &cancel_},
        call_(worker::isolatedStream<writeDecoded>(request_, path, offset, encoding, text)) {}

  Result<std::size_t> read(void* to, std::size_t count) override {
    std::size_t done = 0;
    while (done < count && !ended_) {
      if (left_ == 0) {
        if (Status s = next(); !s) return s.error();
        continue;
      }
      const std::size_t part = std::min<std::uint64_t>(left_, count - done);
      call_->bytes(static_cast<std::uint8_t*>(to) + done, part);
      if (!call_->ok()) return failed();
      left_ -= part, done += part;
    }
    return done;
  }

 private:
  Status next() {
    (*call_)(left_);
    if (left_ == wrong) {
      std::string sentence;
      (*call_)(sentence);
      left_ = 0;
      if (call_->ok()) return Error{sentence};
    }
    ended_ = left_ == 0;
    return call_->ok() ? Status{} : failed();
  }
  Error failed() const {
    return Error{request_.files[0] + ": " + reasonOf(call_->failure(), request_) + "."};
  }

  CancelToken cancel_;
  worker::Request request_;
  std::unique_ptr<worker::Call> call_;
  std::uint64_t left_ = 0;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<ByteSource> decodeIsolated(const std::string& path, std::uint64_t offset, Encoding encoding,
                                           const std::optional<TextSamples>& text,
                                           const CancelToken& cancel) {
  return std::make_unique<IsolatedSource>(path, offset, encoding, text, cancel);
}

}  // namespace volumen
