#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <QString>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "app/command.h"
#include "app/command_line.h"
#include "io/worker/worker.h"

namespace {

const volumen::CancelToken cancelled;
volatile std::sig_atomic_t caught = 0;

// A second Ctrl-C ends the program at once, if the first one takes long.
void onInterrupt(int signal) {
  caught = signal;
  cancelled.cancel();
  std::signal(signal, SIG_DFL);
}

// Reports incomplete output: a script must not take half of it for all.
int flushOutput(int status) {
  const bool flushed = std::cout.flush() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (flushed) return status;
  constexpr int reasons[] = {ENOSPC, EDQUOT, EFBIG, EIO};
  const bool known = std::ranges::find(reasons, errno) != std::end(reasons);
  if (errno == EBADF) return volumen::fail("The output could not be written: stdout is closed.");
  return volumen::fail("Not all of the output could be written" +
                       (known ? std::string(": ") + std::strerror(errno) + "." : std::string(".")));
}

// Ends the program by the caught signal after cleaning up, so that a shell ends its loop, too.
int endBySignal(int status) {
  if (!caught) return status;
  volumen::worker::stop();
  std::raise(caught);
  return status;
}

// Checks the instructions that everything is compiled for (CMakeLists.txt).
bool hasOurInstructions() {
#ifdef __x86_64__
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
#else
  return true;
#endif
}

// Opens closed standard descriptors: otherwise the next opened files or sockets would replace them. Writing
// to a closed stdout still fails.
void openStandardDescriptors() {
  int fd = open("/dev/null", O_RDWR);
  if (fd == STDOUT_FILENO) close(fd), fd = open("/dev/null", O_RDONLY);
  while (fd >= 0 && fd <= 2) fd = open("/dev/null", fd == 0 ? O_RDONLY : O_RDWR);
  if (fd > 2) close(fd);
}

// ITK reads its thread count and even libraries from the environment, which is not meant for this program.
// Relative XDG folders are ignored, as the XDG Base Directory Specification demands.
void forgetForeignSettings() {
  for (const char* name :
       {"ITK_AUTOLOAD_PATH", "ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS", "ITK_GLOBAL_DEFAULT_THREADER", "NSLOTS"})
    unsetenv(name);
  for (const char* name :
       {"XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_RUNTIME_DIR", "XDG_STATE_HOME"})
    if (const char* folder = std::getenv(name); folder && *folder != '/') unsetenv(name);
}

// Qt's messages name files, so they are made printable, too.
void onQtMessage(QtMsgType type, const QMessageLogContext& context, const QString& message) {
  std::cerr << qFormatLogMessage(type, context, message).toStdString() << '\n';
}

std::vector<std::string> argumentsOf(int argc, char** argv) {
  std::vector<std::string> words;
  for (int n = 1; n < argc; ++n) words.push_back(volumen::pathOfArgument(argv[n]));
  return words;
}

// Slices are allocated and freed by the hundred, also in workers, which inherit this. Returning their memory
// to the system would cost a fifth of the loading time of a compressed series (performance.md).
void keepFreedMemory() {
  constexpr int mebibyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * mebibyte);
  mallopt(M_TRIM_THRESHOLD, 64 * mebibyte);
}

}  // namespace

int main(int argc, char** argv) {
  openStandardDescriptors();
  const volumen::PrintableStream out(std::cout), errors(std::cerr);
  qInstallMessageHandler(onQtMessage);
  if (!hasOurInstructions())
    return volumen::fail("volumen needs a processor with SSE4.2 (x86-64-v2, made since 2009).");
  keepFreedMemory();
  volumen::worker::start();
  forgetForeignSettings();
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  if (std::signal(SIGHUP, onInterrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  std::signal(SIGXFSZ, SIG_IGN);  // the writer reports a file that may not grow
  return endBySignal(flushOutput(volumen::CommandLine(cancelled).run(argumentsOf(argc, argv))));
}
