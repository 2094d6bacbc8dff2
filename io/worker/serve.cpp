#include "io/worker/serve.h"

#include <unistd.h>

#include <ctime>
#include <map>
#include <new>

#include "io/worker/call.h"
#include "io/worker/progress.h"
#include "viewer/volume/available_memory.h"

namespace volumen::worker {
namespace {

[[noreturn]] void giveUp() { _exit(1); }

/// The worker's end of the channel, with the files of the current request.
class Server {
 public:
  Server(int socket, SharedBuffer buffer) : socket_(socket), buffer_(std::move(buffer)) {}

  [[noreturn]] void run();
  Message hear(Topic topic);
  void say(const Message& message) {
    if (sendMessage(socket_, message, true) != Transfer::done) giveUp();
  }
  Result<OpenedFile> open(const std::string& path);
  std::uint8_t* nextSlot();
  void sendSlot(std::size_t count, bool last);
  const SharedBuffer& buffer() const { return buffer_; }

 private:
  struct Given {
    Result<std::uint64_t> size;
    Descriptor file;
  };
  std::map<std::string, Given> receiveFiles(Wire& request, std::vector<Descriptor>& files);

  int socket_;
  SharedBuffer buffer_;
  std::map<std::string, Given> given_;  // the request's files
  std::uint64_t piece_ = 0, free_ = 0;  // number of the current piece; number of slots that may be used
};

Server* server = nullptr;
thread_local const Progress* listener = nullptr;  // receives tellRead() outside of workers
bool preparedForAll = false;

/// Writes the answer to one request piece by piece through the slots.
class AnswerWriter : public Wire {
 public:
  AnswerWriter() : Wire(false) {}
  void finish() {
    if (!slot_) nextPiece();
    server->sendSlot(std::size_t(at_ - slot_), true);
  }

 private:
  bool nextPiece() override {
    if (slot_) server->sendSlot(SharedBuffer::slotBytes, false);
    at_ = slot_ = server->nextSlot();
    end_ = slot_ + SharedBuffer::slotBytes;
    return true;
  }
  std::uint8_t* slot_ = nullptr;
};

// Counts the messages `more`, which may arrive at any time.
Message Server::hear(Topic topic) {
  while (true) {
    Message message;
    if (receiveMessage(socket_, message, true) != Transfer::done) giveUp();
    if (message.topic == Topic::more) ++free_;
    if (message.topic == topic) return message;
    if (message.topic != Topic::more) giveUp();
  }
}

std::uint8_t* Server::nextSlot() {
  if (free_ == 0) hear(Topic::more);
  --free_;
  return buffer_.slot(piece_++);
}

void Server::sendSlot(std::size_t count, bool last) { say({Topic::piece, count, last, {}, {}}); }

std::map<std::string, Server::Given> Server::receiveFiles(Wire& request, std::vector<Descriptor>& files) {
  std::vector<GivenFile> list;
  request(list);
  std::map<std::string, Given> given;
  std::size_t next = 0;
  for (GivenFile& file : list) {
    if (file.problem.empty() && next < files.size())
      given.emplace(file.path, Given{file.size, std::move(files[next++])});
    else
      given.emplace(file.path, Given{Error{file.problem}, {}});
  }
  return given;
}

void Server::run() {
  say({Topic::ready, 0, 0, {}, {}});
  while (true) {
    Message message = hear(Topic::run);
    // A request too long for a message is the last of its files.
    std::vector<std::uint8_t> bytes(message.text.begin(), message.text.end());
    if (bytes.empty() && !message.files.empty()) {
      bytes.resize(message.second);
      if (::pread(message.files.back().get(), bytes.data(), bytes.size(), 0) != ssize_t(bytes.size()))
        giveUp();
      message.files.pop_back();
    }
    MemoryReader request(bytes);
    given_ = receiveFiles(request, message.files);
    piece_ = 0, free_ = SharedBuffer::slots;
    AnswerWriter answer;
    reinterpret_cast<Handler>(message.first)(request, answer);
    answer.finish();
    given_.clear();
  }
}

Result<OpenedFile> Server::open(const std::string& path) {
  if (const auto found = given_.find(path); found != given_.end()) {
    if (!found->second.size) return found->second.size.error();
    return OpenedFile{Descriptor(::dup(found->second.file.get())), *found->second.size};
  }
  say({Topic::open, 0, 0, path, {}});
  Message answer = hear(Topic::opened);
  if (answer.files.size() != 1) return Error{answer.text};
  return OpenedFile{std::move(answer.files[0]), answer.first};
}

}  // namespace

bool inside() { return server != nullptr; }

void serve(int socket, SharedBuffer buffer, bool forAll) {
  preparedForAll = forAll;
  expectAllAvailable();
  Server only(socket, std::move(buffer));
  server = &only;
  only.run();
}

Result<OpenedFile> openInside(const std::string& path) { return server->open(path); }

Result<std::string> resolveInside(const std::string& headerPath, const std::string& name) {
  if (headerPath.size() + name.size() >= mostText)
    return Error{headerPath + " refers to a name that is too long."};
  server->say({Topic::resolve, 0, 0, headerPath + '\0' + name, {}});
  Message answer = server->hear(Topic::resolved);
  if (answer.first != 1) return Error{answer.text};
  return answer.text;
}

void needAll() {
  if (server && !preparedForAll) throw Unprepared();
}

void finishStep() {
  if (server) server->buffer().steps().fetch_add(1, std::memory_order_relaxed);
}

void tellRead(std::uint64_t done, std::uint64_t all) {
  if (server) {
    server->buffer().pictureBytes().store(all, std::memory_order_relaxed);
    server->buffer().readBytes().store(done, std::memory_order_relaxed);
  } else if (listener && *listener) {
    (*listener)(readingPicture, done, all);
  }
}

ReadListener::ReadListener(const Progress& progress) : before_(std::exchange(listener, &progress)) {}

ReadListener::~ReadListener() { listener = before_; }

}  // namespace volumen::worker
