#include "ui/widgets/documents_window.h"

#include <QDesktopServices>
#include <QFile>
#include <QHBoxLayout>
#include <QListWidget>
#include <QTextBrowser>

// Outside the namespace, as Qt asks. Without this, the linker leaves the pages in their library.
static void loadPages() { Q_INIT_RESOURCE(documents); }

namespace volumen {
namespace {

const QString folder = QStringLiteral(":/docs/");

// Pages in reading order.
const QStringList pages{
    QStringLiteral("window.md"),   QStringLiteral("import.md"),      QStringLiteral("archives.md"),
    QStringLiteral("accuracy.md"), QStringLiteral("performance.md"), QStringLiteral("picture.md"),
    QStringLiteral("slices.md"),   QStringLiteral("measure.md"),     QStringLiteral("segment.md"),
    QStringLiteral("export.md"),   QStringLiteral("protocols.md"),   QStringLiteral("tasks.md"),
    QStringLiteral("cluster.md"),  QStringLiteral("install.md"),     QStringLiteral("design.md"),
    QStringLiteral("kernels.md")};

// Returns the first heading of a page.
QString titleOf(const QString& page) {
  QFile file(folder + page);
  if (!file.open(QIODevice::ReadOnly)) return page;
  return QString::fromUtf8(file.readLine()).remove(0, 1).trimmed();
}

}  // namespace

DocumentsWindow::DocumentsWindow(QWidget* parent) : QDialog(parent) {
  loadPages();
  setObjectName(QStringLiteral("documents"));
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(tr("volumen: documentation"));
  resize(980, 720);
  auto* list = new QListWidget(this);
  list->setObjectName(QStringLiteral("documentList"));
  list->setAccessibleName(tr("Documents"));
  list->setFixedWidth(230);
  list->setWordWrap(true);
  for (const QString& page : pages) list->addItem(titleOf(page));
  auto* text = new QTextBrowser(this);
  text->setObjectName(QStringLiteral("documentText"));
  text->setAccessibleName(tr("Document"));
  text->setOpenLinks(false);
  auto* row = new QHBoxLayout(this);
  row->addWidget(list);
  row->addWidget(text, 1);
  const auto show = [text](const QString& page) {
    text->setSource(QUrl(QStringLiteral("qrc") + folder + page), QTextDocument::MarkdownResource);
  };
  connect(list, &QListWidget::currentRowChanged, text, [show](int n) { show(pages[n]); });
  connect(text, &QTextBrowser::anchorClicked, list, [list](const QUrl& link) {
    const qsizetype page = pages.indexOf(link.fileName());
    if (page >= 0)
      list->setCurrentRow(int(page));
    else if (!link.scheme().isEmpty())
      QDesktopServices::openUrl(link);
  });
  list->setCurrentRow(0);
}

}  // namespace volumen
