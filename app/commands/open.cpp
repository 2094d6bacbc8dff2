#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QApplication>
#include <QFileInfo>
#include <QSettings>
#include <QTimer>
#include <filesystem>
#include <memory>

#include "app/command.h"
#include "app/usage.h"
#include "io/files/private_folder.h"
#include "io/paths/open_path.h"
#include "results/pictures/scene_files.h"
#include "ui/british.h"
#include "ui/main_window.h"

namespace volumen {

namespace {

constexpr const char* noDisplay =
    "No display can be reached, so no window can be opened: set DISPLAY or WAYLAND_DISPLAY, or use "
    "`volumen render`, which needs no window.";

bool needsDisplay() {
  const QByteArray platform = qgetenv("QT_QPA_PLATFORM");
  return !platform.startsWith("offscreen") && !platform.startsWith("minimal") && !platform.startsWith("vnc");
}

bool namesDisplay() {
  return !qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM") || !qEnvironmentVariableIsEmpty("DISPLAY") ||
         !qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY");
}

// A child process that connects to the display, because QGuiApplication ends a program if its display does
// not answer. It stays connected as long as this object lives. An X server that loses its only client
// restarts, and rejects new clients meanwhile.
class DisplayProbe {
 public:
  DisplayProbe() {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
    child_ = fork();
    if (child_ == 0) {
      ::close(ends[0]);
      connectUntilClosed(ends[1]);
    }
    ::close(ends[1]);
    socket_ = ends[0];
    char answer = 0;
    answers_ = child_ < 0 || ::read(socket_, &answer, 1) == 1;
  }
  DisplayProbe(const DisplayProbe&) = delete;
  DisplayProbe& operator=(const DisplayProbe&) = delete;
  ~DisplayProbe() {
    if (socket_ >= 0) ::close(socket_);
    if (child_ > 0) ::waitpid(child_, nullptr, 0);
  }

  bool answers() const { return answers_; }

 private:
  [[noreturn]] static void connectUntilClosed(int socket) {
    dup2(::open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
    int argc = 1;
    char name[] = "volumen", *argv[] = {name, nullptr};
    const QGuiApplication connected(argc, argv);
    char byte = 0;
    if (::write(socket, &byte, 1) == 1) (void)!::read(socket, &byte, 1);
    _exit(0);
  }

  pid_t child_ = -1;
  int socket_ = -1;
  bool answers_ = true;
};

// The settings name recently opened files, and thus patients.
void keepSettingsPrivate() {
  const QString file = QSettings().fileName();
  if (!makePrivateFolder(QFile::encodeName(QFileInfo(file).path()).toStdString())) return;
  const int fd = ::open(QFile::encodeName(file).constData(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (fd < 0) return;
  ::fchmod(fd, S_IRUSR | S_IWUSR);
  ::close(fd);
}

// Returns the paths that exist, and reports all others.
std::vector<std::string> existing(const std::vector<std::string>& paths) {
  std::vector<std::string> there;
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (isStudyName(path) || std::filesystem::exists(path, ignored))
      there.push_back(path);
    else
      fail("Cannot open " + path + ": no such file or folder.");
  }
  return there;
}

struct OpenOptions {
  std::vector<std::string> paths;
  std::string sceneFile;
};

int run(const OpenOptions& options, const CancelToken& cancel) {
  const std::vector<std::string> paths = existing(options.paths);
  if (paths.empty() && !options.paths.empty()) return exitFailed;
  std::optional<Scene> scene;
  if (!options.sceneFile.empty()) {
    const auto read = sceneFromFile(options.sceneFile);
    if (!read) return fail(read.message());
    scene = *read;
  }
  if (needsDisplay() && !namesDisplay()) return fail(noDisplay);
  std::optional<DisplayProbe> probe;
  if (needsDisplay()) probe.emplace();
  if (probe && !probe->answers()) return fail(noDisplay);
  int argc = 1;
  char name[] = "volumen", *argv[] = {name, nullptr};
  QApplication app(argc, argv);
  probe.reset();
  QApplication::setOrganizationName(QStringLiteral("volumen"));
  QApplication::setApplicationName(QStringLiteral("volumen"));
  QApplication::setApplicationVersion(QStringLiteral(VOLUMEN_VERSION));
  keepSettingsPrivate();
  speakBritish(app);
  MainWindow window(realServices());
  window.show();
  QStringList files;
  for (const std::string& path : options.paths) files << QString::fromStdString(path);
  if (!files.isEmpty()) window.open(files, scene);
  // Ctrl-C in the terminal closes the window.
  QTimer interrupted;
  QObject::connect(&interrupted, &QTimer::timeout, &window, [&] {
    if (cancel.cancelled()) window.end();
  });
  interrupted.start(200);
  return QApplication::exec();
}

}  // namespace

std::function<int()> makeOpen(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<OpenOptions>();
  auto* paths =
      app.add_option("PATH", options->paths, "Files, folders, index:STUDY[/SERIES], archive:NAME/STUDY[/SERIES] or phantom:NAME[:SIZE]")->type_name("");
  app.add_option("--scene", options->sceneFile,
                 "Show the first of them by this scene: a scene file, or a picture that volumen wrote")
      ->type_name("FILE")
      ->needs(paths);
  addExamples(app, {"volumen open scans/", "volumen open chest.nii.gz phantom:ct-head"});
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
