// MP4 by the program ffmpeg (H.264), which gets the pixels at its standard input and writes the temporary
// file.
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QImage>
#include <QStandardPaths>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

#include "io/export/captured_pictures.h"
#include "io/export/film_formats.h"

namespace volumen {

namespace {

using namespace std::chrono_literals;

constexpr auto pollEvery = 20ms;  // for the end of ffmpeg and for a cancelled export

// A running ffmpeg. It is fed over a socket, as writing to a pipe of a program that ended is a signal.
class RunningFfmpeg {
 public:
  static Result<std::unique_ptr<RunningFfmpeg>> start(const std::string& program,
                                                      std::vector<std::string> words);
  ~RunningFfmpeg() {
    if (pid_ > 0) ::kill(pid_, SIGKILL), ::waitpid(pid_, nullptr, 0);
    for (const int fd : {feed_, said_})
      if (fd >= 0) ::close(fd);
  }
  RunningFfmpeg(const RunningFfmpeg&) = delete;
  RunningFfmpeg& operator=(const RunningFfmpeg&) = delete;

  /// Both return false if ffmpeg failed, or the export was cancelled.
  bool write(const char* bytes, std::size_t count, const CancelToken& cancel);
  bool finish(const CancelToken& cancel);
  /// Returns the last line that ffmpeg said of its failure.
  std::string lastLine() const;

 private:
  RunningFfmpeg() = default;
  int feed_ = -1, said_ = -1;
  pid_t pid_ = 0;  // 0: it does not run
};

Result<std::unique_ptr<RunningFfmpeg>> RunningFfmpeg::start(const std::string& program,
                                                            std::vector<std::string> words) {
  std::unique_ptr<RunningFfmpeg> running(new RunningFfmpeg);
  int ends[2];
  running->said_ = ::memfd_create("ffmpeg", MFD_CLOEXEC);
  if (running->said_ < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    return Error{std::strerror(errno)};
  running->feed_ = ends[0];
  std::vector<char*> arguments{const_cast<char*>(program.c_str())};
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, running->said_, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // Ctrl+C is for this program alone
  pid_t pid = 0;
  const int error = ::posix_spawn(&pid, program.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  ::close(ends[1]);
  if (error != 0) return Error{std::strerror(error)};
  running->pid_ = pid;
  return running;
}

bool RunningFfmpeg::write(const char* bytes, std::size_t count, const CancelToken& cancel) {
  while (count > 0 && !cancel.cancelled()) {
    pollfd ready{feed_, POLLOUT, 0};
    if (::poll(&ready, 1, int(pollEvery.count())) <= 0) continue;
    const ssize_t sent = ::send(feed_, bytes, count, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (sent < 0) return false;
    bytes += sent, count -= std::size_t(sent);
  }
  return count == 0;
}

bool RunningFfmpeg::finish(const CancelToken& cancel) {
  ::shutdown(feed_, SHUT_WR);
  int status = 0;
  while (::waitpid(pid_, &status, WNOHANG) == 0) {
    if (cancel.cancelled()) return false;
    std::this_thread::sleep_for(pollEvery);
  }
  pid_ = 0;
  // On a full disk it says so and succeeds all the same.
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 && lastLine().empty();
}

std::string RunningFfmpeg::lastLine() const {
  std::string said(4096, '\0');
  const off_t size = ::lseek(said_, 0, SEEK_END), most = off_t(said.size());
  const ssize_t count = ::pread(said_, said.data(), said.size(), std::max(off_t(0), size - most));
  said.resize(std::size_t(std::max(ssize_t(0), count)));
  while (!said.empty() && (said.back() == '\n' || said.back() == '.')) said.pop_back();
  return said.substr(said.rfind('\n') + 1);
}

std::string ffmpegPath() { return QStandardPaths::findExecutable(QStringLiteral("ffmpeg")).toStdString(); }

class Mp4Film : public FilmFile {
 public:
  Mp4Film(OutputFile out, const std::string& path, int pictures, int perSecond, std::string program)
      : FilmFile(std::move(out), path, pictures, perSecond), program_(std::move(program)) {}

 private:
  Status writeFirst(const QImage& picture, const PictureText& text, const CancelToken& cancel) override {
    const QImage even = evenOf(picture);
    const std::string size = std::to_string(even.width()) + 'x' + std::to_string(even.height());
    auto started = RunningFfmpeg::start(
        program_, {"-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pixel_format", "rgb24",
                   "-video_size", size, "-framerate", std::to_string(perSecond()), "-i", "pipe:0",
                   // Without these words players take large films for another colour space than small ones.
                   "-vf", "scale=out_color_matrix=bt709", "-colorspace", "bt709", "-color_primaries", "bt709",
                   "-color_trc", "bt709", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags",
                   "+faststart", "-metadata", "comment=" + derivationWords(text, pictures()), "-f", "mp4",
                   "file:" + out().asidePath()});
    if (!started) return fail("ffmpeg cannot be started: " + started.message());
    running_ = *std::move(started);
    return send(even, cancel);
  }

  Status writeNext(const QImage& picture, const CancelToken& cancel) override {
    return send(evenOf(picture), cancel);
  }

  Status writeEnd(const CancelToken& cancel) override {
    return running_->finish(cancel) ? Status() : failure(cancel);
  }

  // Colours of the format are for 2 x 2 pixels: an odd size gets a black row or column.
  static QImage evenOf(const QImage& picture) {
    const int width = picture.width() + picture.width() % 2, height = picture.height() + picture.height() % 2;
    return picture.copy(0, 0, width, height);
  }

  Status send(const QImage& picture, const CancelToken& cancel) {
    for (int y = 0; y < picture.height(); ++y)
      if (!running_->write(reinterpret_cast<const char*>(picture.constScanLine(y)),
                           3 * std::size_t(picture.width()), cancel)) {
        running_->finish(cancel);  // its last line is complete then
        return failure(cancel);
      }
    return {};
  }

  Status failure(const CancelToken& cancel) {
    if (cancel.cancelled()) return Error{"Cancelled."};
    const std::string line = running_->lastLine();
    return fail(line.empty() ? "ffmpeg ended early" : "ffmpeg says: " + line);
  }

  const std::string program_;
  std::unique_ptr<RunningFfmpeg> running_;
};

}  // namespace

Result<std::unique_ptr<FilmFile>> beginMp4(const std::string& path, int pictures, int perSecond) {
  std::string program = ffmpegPath();
  if (program.empty()) return Error{"MP4 needs ffmpeg: install the package ffmpeg."};
  auto out = OutputFile::create(path);
  if (!out) return out.error();
  return std::unique_ptr<FilmFile>(
      new Mp4Film(*std::move(out), path, pictures, perSecond, std::move(program)));
}

}  // namespace volumen
