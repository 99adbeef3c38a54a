// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/processes/orphan_notice.h>

#include <QObject>
#include <QStringList>

#include <robotlink/blackboard/system_v.h>
#include <ui/base/notice_bar.h>
#include <ui/sources/match_controller.h>

namespace pitchboard::ui {

void showOrphanNotice(NoticeBar* notices, MatchController* controller) {
  std::vector<int> keys;
  QStringList names;
  for (const link::SegmentInfo& segment :
       link::SystemVSegments::list(controller->options().keyBase.value_or(
           link::MatchNumber{controller->options().match.value_or(0)}.keyBase()))) {
    if (!segment.orphan) continue;
    keys.push_back(segment.key);
    names << QString::number(segment.key);
  }
  if (keys.empty()) return;
  const QString sentence =
      keys.size() == 1
          ? QStringLiteral(
                "A program that has ended did not remove its blackboard (key %1), which still "
                "holds "
                "old values. Removing it restarts the match.")
                .arg(names.front())
          : QStringLiteral(
                "Programs that have ended did not remove %1 blackboards (keys %2), which still "
                "hold old values. Removing them restarts the match.")
                .arg(keys.size())
                .arg(names.join(QStringLiteral(", ")));
  notices->show({QStringLiteral("orphans")}, sentence,
                {{QStringLiteral("Remove"),
                  [controller, keys] {
                    controller->restart([keys] {
                      for (const int key : keys) {
                        const auto segment = link::SystemVSegments::info(key);
                        // Somebody else may have come to use it meanwhile.
                        if (segment && segment->attached == 0) {
                          (void)link::SystemVSegments::remove(key);
                        }
                      }
                    });
                  }},
                 {QStringLiteral("Keep"), {}}});
}

}  // namespace pitchboard::ui
