#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QApplication>
#include <QTimer>
#include <memory>

#include "app/command.h"
#include "ui/british.h"
#include "ui/main_window.h"

namespace volumen {

namespace {

constexpr const char* noDisplay =
    "No display can be reached, so no window can be opened: set DISPLAY or WAYLAND_DISPLAY, or draw "
    "without a window by `volumen render`.";

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
    const int nowhere = open("/dev/null", O_WRONLY);
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

int run(const std::vector<std::string>& paths, const CancelToken& cancel) {
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
  for (const std::string& path : paths) files << QString::fromStdString(path);
  if (!files.isEmpty()) window.open(files);
  // Ctrl-C in the terminal closes the window.
  QTimer interrupted;
  QObject::connect(&interrupted, &QTimer::timeout, &window, [&] {
    if (cancel.cancelled()) window.close();
  });
  interrupted.start(200);
  return QApplication::exec();
}

}  // namespace

std::function<int()> makeOpen(CLI::App& app, const CancelToken& cancel) {
  auto paths = std::make_shared<std::vector<std::string>>();
  app.add_option("PATH", *paths, "Files, folders or phantom:NAME[:SIZE]");
  return [paths, &cancel] { return run(*paths, cancel); };
}

}  // namespace volumen
