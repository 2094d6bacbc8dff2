#include <QDialogButtonBox>
#include <QMessageBox>
#include <QScreen>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "io/worker/worker.h"
#include "ui/features/action_text.h"
#include "ui/features/feature.h"
#include "ui/features/key_table.h"
#include "ui/views/canvas.h"
#include "ui/views/volume_view.h"
#include "ui/widgets/documents_window.h"

namespace volumen {

namespace {

// Shows keys, documents and information about the program.
class Help : public Feature {
 public:
  explicit Help(Workbench& bench);

 private:
  void showAbout();
  void showShortcuts();
};

Help::Help(Workbench& bench) : Feature(bench) {
  const std::vector<Workbench::ActionEntry> table{
      {"documentation",
       tr("Documentation"),
       {QKeySequence::HelpContents},
       "",
       false,
       [this](bool) { (new DocumentsWindow(bench_.dialogParent()))->show(); },
       {{"helpMenu"}}},
      {"shortcuts",
       tr("Mouse and keys"),
       {tr("?")},
       "help",
       false,
       [this](bool) { showShortcuts(); },
       {{"helpMenu"}, {"toolBar", 30, toolBarGap + 20}}},
      {"about", tr("About volumen"), {}, "", false, [this](bool) { showAbout(); }, {{"helpMenu"}}}};
  for (const Workbench::ActionEntry& entry : table) bench_.addAction(entry);
}

void Help::showAbout() {
  const QString reading =
      worker::isolating() ? tr("Files are read in separate processes: no network, no writing, memory and "
                               "time limited. Only samples "
                               "that are not compressed, scenes and sessions are read by the program itself.")
                          : tr("Files are read by the program itself: separate processes for that are not "
                               "possible here, or not "
                               "wanted (--in-process).");
  auto* box =
      new QMessageBox(QMessageBox::NoIcon, tr("About volumen"),
                      tr("<h3>volumen %1</h3><p>A DICOM workstation without a GPU.</p>"
                         "<p><b>Not for clinical use.</b></p>"
                         "<p>Free software under the GNU General Public License, version 3 or later.</p>"
                         "<p>Texts in pictures are written in DejaVu Sans, whose licence is free, too.</p>"
                         "<p>Qt %2. Pictures are shown through: %3.</p><p>%4</p>")
                          .arg(QStringLiteral(VOLUMEN_VERSION), QLatin1String(qVersion()),
                               canvasKind(bench_.view()->canvas()), reading),
                      QMessageBox::Close, bench_.dialogParent());
  box->setObjectName(QStringLiteral("aboutBox"));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setModal(false);
  box->show();
}

void Help::showShortcuts() {
  QString html = QStringLiteral("<table cellpadding='3' width='100%'>");
  const auto add = [&](const QString& keys, const QString& text) {
    html += QStringLiteral("<tr><td><b>%1</b></td><td>%2</td></tr>")
                .arg(keys.toHtmlEscaped(), text.toHtmlEscaped());
  };
  add(keysOf(*bench_.shared.commands), tr("all commands with their keys: type to search"));
  for (const KeyRow& row : keyRows()) add(row.keys, row.text);
  auto* text = new QTextBrowser;
  text->setObjectName(QStringLiteral("shortcutsText"));
  text->setAccessibleName(tr("Mouse and keys"));
  text->setHtml(html + QStringLiteral("</table>"));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  auto* box = new QDialog(bench_.dialogParent());
  box->setObjectName(QStringLiteral("shortcutsBox"));
  box->setWindowTitle(tr("Mouse and keys"));
  box->setAttribute(Qt::WA_DeleteOnClose);
  connect(buttons, &QDialogButtonBox::rejected, box, &QDialog::reject);
  auto* column = new QVBoxLayout(box);
  column->addWidget(text);
  column->addWidget(buttons);
  const QSize room = box->screen()->availableGeometry().size() * 9 / 10;
  box->resize(QSize(760, 720).boundedTo(room));
  box->show();
}

}  // namespace

std::unique_ptr<Feature> makeHelp(Workbench& bench) { return std::make_unique<Help>(bench); }

}  // namespace volumen
