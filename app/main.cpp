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
#include <filesystem>
#include <iostream>
#include <new>

#include "app/command.h"
#include "app/list_presets.h"
#include "app/open_volume.h"
#include "app/startable_threads.h"
#include "app/usage.h"
#include "io/frame_limit.h"
#include "io/paths/open_path.h"
#include "io/worker/worker.h"
#include "viewer/volume/available_memory.h"

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

struct Entry {
  const char* name;
  const char* text;
  volumen::MakeCommand make;
  bool readsSeries = false;
};

constexpr Entry commands[] = {
    {"open", "Open the window", volumen::makeOpen},
    {"render", "Render a picture without a window", volumen::makeRender, true},
    {"slice", "Draw a plane through a volume, or a slab", volumen::makeSlice, true},
    {"info", "List patients, studies and series, with geometry and warnings", volumen::makeInfo, true},
    {"import", "Read studies into the index", volumen::makeImport},
    {"list", "List the studies of the index", volumen::makeList},
    {"archive", "Search archives beside this machine (PACS), fetch from them, send to them, and receive",
     volumen::makeArchive},
    {"forget", "Take studies out of the index; their files stay", volumen::makeForget},
    {"convert", "Write a series as .nrrd, .nii.gz, .mha or DICOM", volumen::makeConvert, true},
    {"export", "Hand on measurements, segments, pictures and slices, or copies without the identity",
     volumen::makeExport},
    {"segment", "Segment by a recipe or a value range, and measure", volumen::makeSegment, true},
    {"compare", "Compare the segments of two files", volumen::makeCompare},
    {"measure", "Measure lengths, angles, regions, volumes and segments", volumen::makeMeasure, true},
    {"accuracy", "Measure what every setting costs in time and accuracy", volumen::makeAccuracy, true},
    {"bench", "Measure how fast a scene is drawn from all around", volumen::makeBench, true},
};

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

bool isPath(const std::string& word) {
  std::error_code ignored;
  return word.empty() || volumen::isStudyName(word) || word.find_first_of("/.") != std::string::npos ||
         std::filesystem::exists(word, ignored);
}

bool isCommand(const std::string& word) {
  return std::any_of(std::begin(commands), std::end(commands),
                     [&](const Entry& entry) { return word == entry.name; });
}

int statusOf(const std::function<int()>& command) {
  try {
    return command();
  } catch (const std::bad_alloc&) {
    return volumen::fail("There was not enough memory (" +
                         volumen::memoryText(volumen::processMemory().available) +
                         " are left); close other programs, or allow more.");
  }
}

int run(std::vector<std::string> words, CLI::App& app, std::function<int()>& command) {
  if (words.empty() || (!isCommand(words[0]) && isPath(words[0]))) words.insert(words.begin(), "open");
  if (!words[0].starts_with('-') && !isCommand(words[0]))
    return volumen::failUsage(volumen::unknownCommand(words[0], app));
  try {
    std::reverse(words.begin(), words.end());
    app.parse(words);
  } catch (const CLI::Success& e) {
    return flushOutput(app.exit(e));
  } catch (const CLI::ParseError& e) {
    const CLI::App* at = &app;
    std::string name = "volumen ";
    while (!at->get_subcommands().empty()) {
      at = at->get_subcommands().front();
      name += at->get_name() + " ";
    }
    return volumen::failUsage(volumen::usageProblem(e, *at) + "\nSee `" + name + "--help`.");
  }
  volumen::keepToStartableThreads();
  return endBySignal(flushOutput(statusOf(command)));
}

// Restarts the workers, as running ones would keep the old limit.
void readFramesUpTo(double megapixels) {
  volumen::setFramePixelLimit(std::uint64_t(megapixels * 1e6));
  if (!volumen::worker::isolating()) return;
  volumen::worker::stop();
  volumen::worker::start();
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
  CLI::App app{
      "volumen shows CT, MR and other scans in 3D, without a GPU. Not for clinical use.\n"
      "PATH is a file, a folder or phantom:NAME[:SIZE], a volume that the program makes."};
  app.name("volumen");
  app.require_subcommand(0, 1);  // else words of a search would be commands, too
  app.formatter(std::make_shared<volumen::HelpFormatter>());
  app.set_help_flag("-h,--help", "Show this help; `volumen COMMAND --help` shows that of a command");
  app.set_version_flag("--version", "volumen " VOLUMEN_VERSION, "Show the version");
  volumen::addListPresets(app);
  volumen::addExamples(app, {"volumen scans/", "volumen render scans/ --preset CT-Bone -o bone.png"});
  app.footer(
      "Exit status: 0 done; 1 failed; 2 wrong usage; 3 done, but files of the series could not be read.\n\n" +
      app.get_footer());
  std::function<int()> command;
  for (const Entry& entry : commands) {
    CLI::App* sub = app.add_subcommand(entry.name, entry.text);
    sub->group("Commands");
    sub->set_help_flag("-h,--help", "Show this help");
    auto runThis = entry.make(*sub, cancelled);
    sub->add_flag_callback("--in-process", volumen::worker::stop)->group("");
    volumen::number(
        sub->add_option_function<double>("--largest-frame", readFramesUpTo,
                                         "Read frames of up to so many million pixels (default: 268)"),
        1, 4295);
    if (entry.readsSeries)
      sub->add_flag_callback(
          "--strict", volumen::refuseLosses,
          "Write nothing, and end with status 1, where a file of the series cannot be read");
    sub->callback([runThis, &command] { command = runThis; });
  }
  return run(argumentsOf(argc, argv), app, command);
}
