#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QApplication>
#include <QTimer>
#include <filesystem>
#include <memory>

#include "app/command.h"
#include "app/usage.h"
#include "ui/british.h"
#include "ui/controller/scene_files.h"
#include "ui/main_window.h"

namespace volumen {

namespace {

constexpr const char* noDisplay =
    "No display can be reached, so no window can be opened: set DISPLAY or WAYLAND_DISPLAY, or use "
    "`volumen render`, which needs no window.";

// QGuiApplication ends the program where the display does not answer, so it is tried in a child process
// first.
bool displayAnswers() {
  const QByteArray platform = qgetenv("QT_QPA_PLATFORM");
  if (platform.startsWith("offscreen") || platform.startsWith("minimal") || platform.startsWith("vnc"))
    return true;
  if (platform.isEmpty() && qEnvironmentVariableIsEmpty("DISPLAY") &&
      qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY"))
    return false;
  const pid_t child = fork();
  if (child < 0) return true;
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    dup2(nowhere, STDERR_FILENO);
    int argc = 1;
    char name[] = "volumen", *argv[] = {name, nullptr};
    const QGuiApplication probe(argc, argv);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// The paths that are there; every other one is complained about.
std::vector<std::string> existing(const std::vector<std::string>& paths) {
  std::vector<std::string> there;
  for (const std::string& path : paths) {
    std::error_code ignored;
    if (path.starts_with("phantom:") || std::filesystem::exists(path, ignored))
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
  if (!displayAnswers()) return fail(noDisplay);
  int argc = 1;
  char name[] = "volumen", *argv[] = {name, nullptr};
  QApplication app(argc, argv);
  QApplication::setOrganizationName(QStringLiteral("volumen"));
  QApplication::setApplicationName(QStringLiteral("volumen"));
  QApplication::setApplicationVersion(QStringLiteral(VOLUMEN_VERSION));
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
      app.add_option("PATH", options->paths, "Files, folders or phantom:NAME[:SIZE]")->type_name("");
  app.add_option("--scene", options->sceneFile,
                 "Show the first of them by this scene: a scene file, or a picture that volumen wrote")
      ->type_name("FILE")
      ->needs(paths);
  addExamples(app, {"volumen open scans/", "volumen open chest.nii.gz phantom:ct-head"});
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
