#include "io/worker/call.h"

#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "io/files/data_file.h"
#include "io/regular_file.h"
#include "io/worker/process.h"
#include "viewer/volume/available_memory.h"

namespace volumen::worker {
namespace {

constexpr double patienceSeconds = 5;
constexpr double leastBytesPerSecond = 4e6;  // rate of an answer on a slow machine
constexpr double busyMachine = 4;            // factor on the time limit while the worker gets little CPU time
constexpr std::size_t mostQuestions = 50'000;  // questions of a worker for one request, and 4 more a file
constexpr std::uint64_t memoryBytes = std::uint64_t(512) << 20;

/// Returns memory that holds a request too long for a message.
Descriptor inMemory(const std::vector<std::uint8_t>& bytes) {
  Descriptor memory(memfd_create("volumen request", MFD_CLOEXEC));
  std::size_t done = 0;
  while (memory && done < bytes.size()) {
    const ssize_t n = ::write(memory.get(), bytes.data() + done, bytes.size() - done);
    if (n <= 0) return {};
    done += std::size_t(n);
  }
  return memory;
}

constexpr const char* whoNeedsMemory = "the process that is to read it";

/// Returns how many files to pass at once, given the limit on open descriptors.
std::size_t mostGiven() {
  rlimit open{};
  return getrlimit(RLIMIT_NOFILE, &open) == 0 ? std::size_t(open.rlim_cur / 8) : 0;
}

/// Opens files of a request, as many as may be open, if all fit one message. Workers ask for those left out.
std::vector<GivenFile> openAll(const std::vector<std::string>& paths, std::vector<Descriptor>& open) {
  std::vector<GivenFile> given;
  if (paths.size() >= mostDescriptors) return given;
  const std::size_t most = mostGiven();
  for (const std::string& path : paths) {
    if (given.size() == most) break;
    Result<RegularFile> file = RegularFile::open(path);
    if (!file && file.message() == tooManyOpen) break;
    given.push_back({path, file ? file->size() : 0, file ? std::string() : file.message()});
    if (file) open.emplace_back(std::move(*file).release());
  }
  return given;
}

}  // namespace

const char* reasonOf(Failure failure) {
  switch (failure) {
    case Failure::none:
      break;
    case Failure::ended:
      return "it ended the process that was to read it: it is damaged, or made to do harm";
    case Failure::slow:
      return "reading it took more than 5 s and came to nothing";
    case Failure::wrong:
      return "the process that was to read it gave a wrong answer";
    case Failure::memory:
      return "reading it needs more memory than its size allows for";
    case Failure::cancelled:
      return "interrupted";
    case Failure::noWorker:
      return "no process could be started to read it: end others, or allow more (ulimit -u), and try again";
    case Failure::noRoom:
      return "no memory could be shared with a process that was to read it, as files may not grow so far: "
             "allow more (ulimit -f)";
    case Failure::noOpening:
      return tooManyOpen;
    case Failure::stopped:
      return "the processes that were to read it were stopped from outside: try again";
    case Failure::killed:
      return "the processes that were to read it were killed from outside (is there enough memory?): try "
             "again";
    case Failure::scarce:
      return "there is not enough memory for the process that is to read it: close other programs, or allow "
             "more, and try again";
  }
  return "";
}

std::string reasonOf(Failure failure, const Request& request) {
  if (failure != Failure::scarce) return reasonOf(failure);
  std::string sentence = tooLittleMemory(whoNeedsMemory, PromisedMemory::bytesFor(request.needBytes)).message;
  sentence.pop_back();  // the full stop
  return sentence;
}

bool isReasonOfMachine(const std::string& reason) {
  if (reason.starts_with(whoNeedsMemory)) return true;
  for (int n = 0; n <= int(Failure::scarce); ++n)
    if (isOfMachine(Failure(n)) && reason == reasonOf(Failure(n))) return true;
  return false;
}

Call::Call(Request& request, Handler handler, const std::vector<std::uint8_t>& arguments, bool inNew)
    : Wire(true), request_(request), handler_(handler), known_(request.files) {
  std::ranges::sort(known_);
  reservable_ = request_.mostBytes;
  request_.found.clear();
  request_.stepsDone = 0;
  if (request_.files.size() == 1) failure_ = costBefore(handler_, request_.files[0]);
  if (failure_ == Failure::none) {
    promised_ = PromisedMemory::of(request_.needBytes, request_.cancel);
    if (!promised_)
      failure_ = request_.cancel && request_.cancel->cancelled() ? Failure::cancelled : Failure::scarce;
  }
  if (failure_ != Failure::none) {
    Wire::fail();
    return;
  }
  worker_ = inNew ? makeWorker() : takeWorker();
  // An idle worker may have been killed.
  if (worker_ && !begin(handler, arguments)) {
    worker_ = makeWorker();
    if (worker_ && !begin(handler, arguments)) worker_.reset();
  }
  if (!worker_) fail(whyNoWorker());
}

Call::~Call() {
  if (worker_ && last_ && failure() == Failure::none) giveBack(std::move(worker_));
}

void Call::fail(Failure why) {
  if (failure_ == Failure::none) {
    if (why == Failure::ended && worker_->endsKilled()) why = Failure::killed;
    failure_ = why;
    if (request_.files.size() == 1) rememberCost(handler_, request_.files[0], why);
  }
  Wire::fail();
}

bool Call::finish() {
  if (ok() && (!last_ || at_ != end_)) {
    // An answer may end exactly at the end of a slot.
    if (at_ != end_ || nextPiece()) fail(Failure::wrong);
  }
  if (!ok()) fail(Failure::wrong);
  return ok() && failure_ == Failure::none;
}

bool Call::begin(Handler handler, const std::vector<std::uint8_t>& arguments) {
  Message order{Topic::run, reinterpret_cast<std::uint64_t>(handler), 0, {}, {}};
  MemoryWriter writer;
  writer.write(openAll(request_.files, order.files));
  std::vector<std::uint8_t> bytes = std::move(writer).take();
  bytes.insert(bytes.end(), arguments.begin(), arguments.end());
  order.second = bytes.size();
  if (bytes.size() <= mostText)
    order.text.assign(bytes.begin(), bytes.end());
  else
    order.files.push_back(inMemory(bytes));
  worker_->limitMemory(memoryBytes + 4 * request_.needBytes);
  worker_->buffer.steps().store(0, std::memory_order_relaxed);
  worker_->buffer.readBytes().store(0, std::memory_order_relaxed);
  worker_->buffer.pictureBytes().store(0, std::memory_order_relaxed);
  worker_->files += std::max<std::size_t>(1, request_.files.size());
  cpuAtStep_ = worker_->cpuSeconds();
  return sendMessage(worker_->socket.get(), order, false) == Transfer::done;
}

bool Call::nextPiece() {
  if (!worker_ || last_ || failure_ != Failure::none) return false;
  if (pieces_ > 0 &&
      sendMessage(worker_->socket.get(), {Topic::more, 0, 0, {}, {}}, false) != Transfer::done) {
    fail(Failure::ended);
    return false;
  }
  Message message;
  do {
    if (!await(message)) return false;
  } while (message.topic != Topic::piece && serveFiles(message));
  if (failure_ != Failure::none) return false;
  const std::uint64_t count = message.first;
  last_ = message.second == 1;
  received_ += count;
  tellProgress();
  if (count > SharedBuffer::slotBytes || (!last_ && count < SharedBuffer::slotBytes) ||
      received_ > request_.mostBytes) {
    fail(Failure::wrong);
    return false;
  }
  at_ = worker_->buffer.slot(pieces_++);
  end_ = at_ + count;
  return count > 0;
}

bool Call::await(Message& message) {
  using Clock = std::chrono::steady_clock;
  constexpr int lookUpMs = 20;
  constexpr double mostAtOnce = 0.2;  // seconds: a longer wait means that the program itself was stopped
  while (true) {
    const Transfer got = receiveMessage(worker_->socket.get(), message, false);
    if (got == Transfer::done) return true;
    const Clock::time_point from = Clock::now();
    pollfd ready{worker_->socket.get(), POLLIN, 0};
    if (got == Transfer::later) ::poll(&ready, 1, lookUpMs);
    waited_ += std::min(mostAtOnce, std::chrono::duration<double>(Clock::now() - from).count());
    noteProgress();
    if (got == Transfer::broken) fail(Failure::ended);
    if (request_.cancel && request_.cancel->cancelled()) fail(Failure::cancelled);
    if (waited_ > patienceSeconds && outOfPatience())
      fail(worker_->isStopped() ? Failure::stopped : Failure::slow);
    if (failure_ != Failure::none) return false;
  }
}

// Each step has its own time limit. Otherwise the time saved by many quick steps would let a stopped worker
// block for minutes.
void Call::noteProgress() {
  tellProgress();
  const std::uint32_t done =
      std::min(request_.steps, worker_->buffer.steps().load(std::memory_order_relaxed));
  if (done == request_.stepsDone) return;
  request_.stepsDone = done;
  waited_ = 0;
  cpuAtStep_ = worker_->cpuSeconds();
}

// Each byte counts twice: once it is read, and once it has arrived.
void Call::tellProgress() const {
  if (!request_.progress) return;
  const std::uint64_t all =
      std::min(request_.mostBytes, worker_->buffer.pictureBytes().load(std::memory_order_relaxed));
  const std::uint64_t read = std::min(all, worker_->buffer.readBytes().load(std::memory_order_relaxed));
  if (all > 0) request_.progress(readingPicture, read + std::min(all, received_), 2 * all);
}

bool Call::outOfPatience() const {
  const double allowed = patienceSeconds + double(received_ + request_.needBytes) / leastBytesPerSecond;
  if (waited_ <= allowed) return false;
  return worker_->sleeps() || worker_->isStopped() || worker_->cpuSeconds() - cpuAtStep_ > allowed ||
         waited_ > busyMachine * allowed;
}

/// Answers a worker that asks for a file. Returns false if the request does not allow that file.
bool Call::serveFiles(const Message& message) {
  if (++questions_ > mostQuestions + 4 * known_.size()) fail(Failure::wrong);
  if (failure_ != Failure::none) return false;
  const auto isKnown = [&](const std::string& path) { return std::ranges::binary_search(known_, path); };
  Message answer{Topic::opened, 0, 0, {}, {}};
  if (message.topic == Topic::open && isKnown(message.text)) {
    Result<RegularFile> file = RegularFile::open(message.text);
    if (file) {
      answer.first = file->size();
      answer.files.emplace_back(std::move(*file).release());
    } else if (file.message() == tooManyOpen) {
      fail(Failure::noOpening);
      return false;
    } else {
      answer.text = file.message();
    }
  } else if (const std::size_t end = message.text.find('\0'); message.topic == Topic::resolve &&
                                                              end != std::string::npos &&
                                                              isKnown(message.text.substr(0, end))) {
    const Result<std::string> path = resolveBeside(message.text.substr(0, end), message.text.substr(end + 1));
    answer = {Topic::resolved, path.ok(), 0, path ? *path : path.message(), {}};
    if (path && !isKnown(*path)) {
      known_.insert(std::ranges::upper_bound(known_, *path), *path);
      request_.found.push_back(*path);
    }
  } else {
    fail(Failure::wrong);
    return false;
  }
  if (sendMessage(worker_->socket.get(), answer, false) == Transfer::done) return true;
  fail(Failure::ended);
  return false;
}

}  // namespace volumen::worker
