#include "ui/panels/link_menu.h"

#include "results/text/text.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/link_text.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Calls `show` when links, or series that could be linked, may have changed.
void connectLinks(Session& session, QAction* action, const std::function<void()>& show) {
  whenChanged(session, action, show, showsOther, &Workspace::links, &Workspace::frameLinks);
}

void addLink(QMenu* menu, Session& session, const char* name, const QString& text, bool Links::*link) {
  QAction* action = menu->addAction(text);
  action->setObjectName(QLatin1String(name));
  action->setCheckable(true);
  const auto show = [action, &session, link] { action->setChecked(session.workspace().links.*link); };
  connectLinks(session, action, show);
  QObject::connect(action, &QAction::triggered, menu, [&session, text, link](bool on) {
    session.endGesture();
    Workspace after = session.workspace();
    if (link == &Links::scroll)
      after = withScrollLinked(std::move(after), on);
    else
      after.links.*link = on;
    session.change(tr("Link: %1").arg(text), after);
  });
  show();
}

void addAct(QMenu* menu, Session& session, const char* name, const QString& text,
            bool (*can)(const Workspace&), const std::function<void()>& act) {
  QAction* action = menu->addAction(text, menu, act);
  action->setObjectName(QLatin1String(name));
  const auto show = [action, &session, can] { action->setEnabled(can(session.workspace())); };
  connectLinks(session, action, show);
  show();
}

}  // namespace

QMenu* makeLinkMenu(Session& session, std::function<void()> registerThem, QWidget* parent) {
  auto* menu = new QMenu(tr("Link"), parent);
  menu->setObjectName(QStringLiteral("linkMenu"));
  addLink(menu, session, "linkScroll", tr("Scroll"), &Links::scroll);
  addLink(menu, session, "linkZoom", tr("Zoom"), &Links::zoom);
  addLink(menu, session, "linkPan", tr("Pan"), &Links::pan);
  addLink(menu, session, "linkWindow", tr("Window"), &Links::window);
  menu->addSeparator();
  addAct(menu, session, "lockHere", tr("Lock here"), canLock, [&session] {
    session.endGesture();
    session.change(tr("Lock here"), lockedHere(session.workspace()));
  });
  addAct(menu, session, "register", tr("Register in the background"), canRegister, registerThem);
  addAct(menu, session, "unlock", tr("Unlock"), canUnlock, [&session] {
    session.endGesture();
    session.change(tr("Unlock"), unlocked(session.workspace()));
  });
  QAction* title = menu->menuAction();
  title->setObjectName(QStringLiteral("link"));
  const auto tell = [title, &session] { title->setToolTip(toolTipOf(linkSentence(session.workspace()))); };
  connectLinks(session, title, tell);
  tell();
  return menu;
}

}  // namespace volumen
