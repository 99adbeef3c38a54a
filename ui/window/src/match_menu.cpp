// SPDX-License-Identifier: GPL-3.0-or-later
#include "match_menu.h"

#include <QInputDialog>
#include <QMenu>
#include <array>

#include <robotlink/blackboard/match_number.h>
#include <ui/base/notice_bar.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/window/main_window.h>

namespace pitchboard::ui {
namespace {

struct WhoDecides {
  link::Cognition cognition;
  const char* choice;
  const char* tip;
  const char* fact;  // in the line about this match
};
constexpr std::array<WhoDecides, 3> choices{{
    {link::Cognition::Separate, "In &separate processes",
     "As on the field: one process per task and robot, on blackboards that other programs can open",
     "separate robot processes"},
    {link::Cognition::Inline, "&Inside the studio",
     "The same processes as part of the match. Other programs cannot open their blackboards",
     "processes inside the studio"},
    {link::Cognition::None, "Only &your team's programs",
     "Creates the blackboards and waits for the programs that you start", "team programs only"},
}};

/// "Match 3 · seed 42 · robots decide in the studio", what a match was started with.
QString matchFacts(const MatchController& controller) {
  QStringList facts;
  const FramePtr frame = controller.frame();
  // A match that nobody outside can reach needs no number.
  if (frame && frame->matchNumber) facts << QStringLiteral("Match %1").arg(*frame->matchNumber);
  facts << QStringLiteral("seed %1").arg(controller.scenario().settings.seed);
  for (const WhoDecides& each : choices) {
    if (each.cognition == controller.cognition()) facts << QString::fromUtf8(each.fact);
  }
  QString text = facts.join(QStringLiteral(" · "));
  text.front() = text.front().toUpper();
  return text;
}

void askForSeed(MatchController* controller, MainWindow* window) {
  link::Scenario again = controller->beginning();
  bool chosen = false;
  const QString text = QInputDialog::getText(
      window, QStringLiteral("Seed"), QStringLiteral("The same seed repeats the same match. Seed:"),
      QLineEdit::Normal, QString::number(again.settings.seed), &chosen);
  if (!chosen) return;
  bool good = false;
  const qulonglong wanted = text.trimmed().toULongLong(&good);
  if (!good) {
    window->notices()->show(
        {QStringLiteral("refused")},
        QStringLiteral("“%1” is not a valid seed. Enter a whole number, 0 or higher.").arg(text));
    return;
  }
  again.settings.seed = wanted;
  controller->edits()->replaceMatch(again, QStringLiteral("Play with seed %1").arg(wanted),
                                    QStringLiteral("Playing with seed %1").arg(wanted),
                                    controller->isPaused());
}

void fillWhoDecides(QMenu* menu, MatchController* controller) {
  menu->clear();
  for (const WhoDecides& each : choices) {
    QAction* action = menu->addAction(QString::fromUtf8(each.choice), controller,
                                      [controller, where = each.cognition] {
                                        controller->setCognition(where);
                                        controller->restart();
                                      });
    action->setToolTip(QString::fromUtf8(each.tip) + QStringLiteral(". Restarts the match."));
    action->setCheckable(true);
    action->setChecked(controller->cognition() == each.cognition);
  }
}

void fillNumbers(QMenu* menu, MatchController* controller, MainWindow* window) {
  menu->clear();
  const std::optional<int> wanted = controller->options().match;
  const auto begin = [controller](std::optional<int> number) {
    controller->setMatchNumber(number);
    controller->restart();
  };
  QAction* any = menu->addAction(QStringLiteral("The next &free one"), controller,
                                 [begin] { begin(std::nullopt); });
  any->setCheckable(true);
  any->setChecked(!wanted);
  menu->addSeparator();
  constexpr int listed = 9;
  for (int number = 0; number <= listed; ++number) {
    QAction* action =
        menu->addAction(number == 0 ? QStringLiteral("&0, the published keys and ports")
                                    : QStringLiteral("&%1").arg(number),
                        controller, [begin, number] { begin(number); });
    action->setCheckable(true);
    action->setChecked(wanted == number);
  }
  QAction* another = menu->addAction(
      wanted > listed ? QStringLiteral("Another… (%1)").arg(*wanted) : QStringLiteral("Another…"),
      window, [begin, wanted, window] {
        bool chosen = false;
        const int number = QInputDialog::getInt(
            window, QStringLiteral("Match number"),
            QStringLiteral("Sets blackboard keys and ports (0 to %1). The match restarts. Number:")
                .arg(link::MatchNumber::most),
            wanted.value_or(0), 0, link::MatchNumber::most, 1, &chosen);
        if (chosen) begin(number);
      });
  another->setCheckable(true);
  another->setChecked(wanted > listed);
}

}  // namespace

void addMatchEntries(QMenu* menu, MatchController* controller, MainWindow* window,
                     const std::function<void(QAction*)>& onlyInTheMatch) {
  QAction* seed = menu->addAction(QStringLiteral("S&eed…"), window,
                                  [controller, window] { askForSeed(controller, window); });
  seed->setObjectName(QStringLiteral("matchSeed"));
  onlyInTheMatch(seed);
  QMenu* who = menu->addMenu(QStringLiteral("Run robot &processes"));
  who->setObjectName(QStringLiteral("whoDecides"));
  QObject::connect(who, &QMenu::aboutToShow, who,
                   [who, controller] { fillWhoDecides(who, controller); });
  onlyInTheMatch(who->menuAction());
  QMenu* number = menu->addMenu(QStringLiteral("Match &number"));
  number->setObjectName(QStringLiteral("matchNumber"));
  QObject::connect(number, &QMenu::aboutToShow, number,
                   [number, controller, window] { fillNumbers(number, controller, window); });
  onlyInTheMatch(number->menuAction());
  QAction* facts = menu->addAction(QStringLiteral("This match"));
  facts->setObjectName(QStringLiteral("matchFacts"));
  facts->setEnabled(false);
  QObject::connect(menu, &QMenu::aboutToShow, facts,
                   [facts, controller] { facts->setText(matchFacts(*controller)); });
}

}  // namespace pitchboard::ui
