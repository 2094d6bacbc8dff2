#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/worker/costly_files.h"
#include "io/worker/progress.h"
#include "io/worker/promised_memory.h"
#include "io/worker/worker.h"
#include "viewer/volume/cancel.h"

namespace volumen::worker {

/// The files and limits that a worker gets for one request.
struct Request {
  std::vector<std::string> files;  ///< files that the worker may open, besides those their headers refer to
  std::uint64_t needBytes = 0;     ///< memory its result needs; the limit is 4 times that plus 512 MiB
  std::uint64_t mostBytes = 64 << 20;  ///< largest size of its answer
  std::uint32_t steps = 0;  ///< number of steps it may report (finishStep); each one restarts its time limit
  const CancelToken* cancel = nullptr;
  Progress progress = {};  ///< reports bytes of a picture (tellRead()) that are read and that have arrived

  std::vector<std::string> found = {};  ///< set by the call: files that headers refer to, resolved
  std::uint32_t stepsDone = 0;          ///< set by the call: number of finished steps
};

/// A file that comes with a request: open, or with the problem that prevented opening it.
struct GivenFile {
  std::string path;
  std::uint64_t size = 0;
  std::string problem;
};
inline void fields(Wire& w, GivenFile& f) { w(f.path, f.size, f.problem); }

/// Returns the reason that follows a file's name in a message, without full stop: "reading it took more than
/// 5 s".
const char* reasonOf(Failure failure);

/// Does the same, with both figures if there is too little memory for the request.
std::string reasonOf(Failure failure, const Request& request);

/// Returns whether `reason` is one of the machine, not of the file (isOfMachine).
bool isReasonOfMachine(const std::string& reason);

struct Process;

/// Makes all new workers be prepared for all (prepareToServe).
void prepareForAll();

/// A request that a worker serves. Its answer is read from the Call as it arrives. A worker that ends,
/// exceeds its time or sends nonsense is killed. One that has answered serves again. A request about a single
/// file that cost a worker before fails at once, for the same reason (costBefore).
class Call : public Wire {
 public:
  /// Starts the request, in a newly made worker if `inNew`.
  Call(Request& request, Handler handler, const std::vector<std::uint8_t>& arguments, bool inNew = false);
  ~Call() override;

  Failure failure() const { return failure_ == Failure::none && !ok() ? Failure::wrong : failure_; }
  /// Returns whether the answer was complete and has been read to its end.
  bool finish();
  void fail(Failure why);

 private:
  bool nextPiece() override;
  bool begin(Handler handler, const std::vector<std::uint8_t>& arguments);
  bool await(Message& message);
  bool serveFiles(const Message& message);
  void noteProgress();
  void tellProgress() const;
  bool outOfPatience() const;

  Request& request_;
  Handler handler_;
  std::optional<PromisedMemory> promised_;
  std::unique_ptr<Process> worker_;
  std::vector<std::string> known_;
  Failure failure_ = Failure::none;
  std::uint64_t pieces_ = 0, received_ = 0;
  std::size_t questions_ = 0;
  bool last_ = false;
  double waited_ = 0, cpuAtStep_ = 0;  // seconds: since the last step; CPU time of the worker at that step
};

/// The return type of a function, without the Result around it.
template <class T>
struct ValueOf {
  using type = T;
};
template <class T>
struct ValueOf<Result<T>> {
  using type = T;
};

template <class F>
struct Signature;
template <class R, class... P>
struct Signature<R (*)(P...)> {
  using Value = typename ValueOf<R>::type;
  using Arguments = std::tuple<std::decay_t<P>...>;
  static std::vector<std::uint8_t> written(const std::decay_t<P>&... arguments) {
    MemoryWriter writer;
    writer.write(arguments...);
    return std::move(writer).take();
  }
};
template <class... P>
struct Signature<void (*)(Wire&, P...)> : Signature<bool (*)(P...)> {};

/// The first value of an answer.
enum class Outcome { value, error, noMemory, unprepared };
template <>
inline constexpr Outcome lastOf<Outcome> = Outcome::unprepared;

/// Runs `function` in a worker and writes its answer.
template <auto function>
void answerWith(Wire& arguments, Wire& answer) {
  using S = Signature<decltype(function)>;
  try {
    typename S::Arguments read;
    arguments(read);
    Result<typename S::Value> result = std::apply(function, read);
    answer.write(result ? Outcome::value : Outcome::error);
    if (result)
      answer.write(*result);
    else
      answer.write(result.message());
  } catch (const std::bad_alloc&) {
    answer.write(Outcome::noMemory);
  } catch (const Unprepared&) {
    answer.write(Outcome::unprepared);
  }
}

template <auto function>
void streamWith(Wire& arguments, Wire& answer) {
  typename Signature<decltype(function)>::Arguments read;
  arguments(read);
  std::apply([&](auto&... each) { function(answer, each...); }, read);
}

/// Returns function(arguments...), run in a worker if there are any, else in this process. `function` may
/// only read files and compute. If the worker was stopped or killed from outside, a new worker gets one more
/// try. An Error is the function's own, or a reason without full stop: `failure` tells which.
template <auto function, class... Arguments>
auto isolated(Request& request, Failure& failure, const Arguments&... arguments)
    -> Result<typename Signature<decltype(function)>::Value> {
  using S = Signature<decltype(function)>;
  failure = Failure::none;
  if (!isolating()) {
    const ReadListener listening(request.progress);
    return function(arguments...);
  }
  Outcome outcome = Outcome::unprepared;
  typename S::Value value{};
  std::string message;
  bool disturbed = false;
  for (int tries = 0; tries < 3 && outcome == Outcome::unprepared; ++tries) {
    Call call(request, &answerWith<function>, S::written(arguments...), disturbed);
    call(outcome);
    if (outcome == Outcome::noMemory) call.fail(Failure::memory);
    if (outcome == Outcome::value) call(value);
    if (outcome == Outcome::error) call(message);
    if (call.finish()) {
      if (outcome == Outcome::unprepared) prepareForAll();
      continue;
    }
    failure = call.failure();
    const bool wasDisturbed = std::exchange(disturbed, true);
    if (wasDisturbed || (failure != Failure::stopped && failure != Failure::killed))
      return Error{reasonOf(failure, request)};
    failure = Failure::none, outcome = Outcome::unprepared;
  }
  if (outcome == Outcome::unprepared) failure = Failure::wrong, message = reasonOf(failure);
  return outcome == Outcome::value ? Result<typename S::Value>(std::move(value)) : Error{message};
}

/// Runs function(answer, arguments...) in a worker. The function writes its answer bit by bit and the caller
/// reads it from the returned Call. Requires isolating().
template <auto function, class... Arguments>
std::unique_ptr<Call> isolatedStream(Request& request, const Arguments&... arguments) {
  using S = Signature<decltype(function)>;
  return std::make_unique<Call>(request, &streamWith<function>, S::written(arguments...));
}

}  // namespace volumen::worker
