// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/note_board.h>

#include <QAction>
#include <QMenu>
#include <QUndoCommand>
#include <algorithm>
#include <utility>

#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/retired_match.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {

using telemetry::DrawnNote;
using telemetry::NoteShape;

namespace {

QString fromUtf8(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

QString sentenceOf(const Error& error) {
  QString text = QString::fromStdString(error.text());
  if (!text.endsWith(QLatin1Char('.'))) text += QLatin1Char('.');
  return text;
}

}  // namespace

/// Notes before and after; empty where there was or is none.
class NoteBoard::Change : public QUndoCommand {
 public:
  Change(NoteBoard* board, const QString& text, Before before, Before after)
      : QUndoCommand(text),
        m_board(board),
        m_before(std::move(before)),
        m_after(std::move(after)) {}
  void redo() override { carryOut(m_after); }
  void undo() override { carryOut(m_before); }

 private:
  void carryOut(const Before& notes) {
    for (const auto& [id, note] : notes) m_board->put(id, note);
    m_board->changedHere();
  }
  NoteBoard* m_board;
  Before m_before, m_after;
};

NoteBoard::NoteBoard(ShownMoment* shown, MatchController* match, ReplayController* replay,
                     SessionRecording* recording, QObject* parent)
    : QObject(parent), m_shown(shown), m_replay(replay), m_recording(recording) {
  struct Tool {
    const char *id, *text, *icon, *tip;
  };
  static constexpr Tool tools[] = {
      {"noteText", "&Text note", "draw-text", "Click where the text belongs: field, plot or video"},
      {"noteArrow", "&Arrow", "draw-arrow", "Drag from the tail to the tip: field, plot or video"},
      {"noteCircle", "&Circle", "draw-circle", "Drag from the centre: field, plot or video"}};
  for (std::size_t i = 0; i < m_tools.size(); ++i) {
    const Tool& tool = tools[i];
    auto* action =
        new QAction(themedIcon(QLatin1String(tool.icon)), QString::fromUtf8(tool.text), this);
    action->setObjectName(QLatin1String(tool.id));
    action->setToolTip(QString::fromUtf8(tool.tip));
    action->setCheckable(true);
    connect(action, &QAction::triggered, this, [this, i](bool on) {
      setTool(on ? std::optional(static_cast<NoteShape>(i)) : std::nullopt);
    });
    m_tools[i] = action;
  }
  const auto begin = [this] {
    m_undo.clear();
    cancel();
    listEvents();
    emit changed();
  };
  connect(shown, &ShownMoment::sourceChanged, this, begin);
  for (FrameSource* source : shown->sources()) {
    connect(source, &FrameSource::restarted, this, [this, source] { forget(source); });
    connect(source, &FrameSource::rewound, this,
            [this, source](double time) { forgetAfter(source, time); });
  }
  connect(replay, &ReplayController::opened, this, &NoteBoard::takeRecording);
  if (match != nullptr) {
    connect(match, &MatchController::retiring, this, [this, match](RetiredMatch& retired) {
      for (const Entry& one : m_of[match]) retired.drawn.push_back(one.note);
    });
    // Its recording is complete, and that of the next match begins before it is shown.
    connect(match, &MatchController::ending, this, [this, match] { m_of[match].clear(); });
    connect(match, &MatchController::broughtBack, this, [this, match](const RetiredMatch& retired) {
      for (const DrawnNote& note : retired.drawn) m_of[match].push_back({++m_lastId, note});
      if (m_shown->source() == match) changedHere();
    });
  }
  if (recording != nullptr) {
    connect(recording, &SessionRecording::began, this, &NoteBoard::beginRecorded);
    recording->setDrawnNotes([this](FrameSource* source) {
      std::vector<DrawnNote> all;
      for (const Entry& one : m_of[source]) all.push_back(one.note);
      return all;
    });
  }
}

NoteBoard::~NoteBoard() {
  if (m_recording != nullptr) m_recording->setDrawnNotes({});
  flush();
}

void NoteBoard::flush() {
  while (m_isWriting) {
    m_worker.waitForDone();
    m_ui.deliver();
  }
}

std::vector<NoteBoard::Entry>& NoteBoard::own() {
  return m_of[m_shown->source()];
}

const std::vector<NoteBoard::Entry>& NoteBoard::entries() const {
  static const std::vector<Entry> none;
  const auto found = m_of.find(m_shown->source());
  return found != m_of.end() ? found->second : none;
}

std::vector<DrawnNote> NoteBoard::notes() const {
  std::vector<DrawnNote> all;
  for (const Entry& one : entries()) all.push_back(one.note);
  return all;
}

std::optional<DrawnNote> NoteBoard::find(quint64 id) const {
  const auto found = std::ranges::find(entries(), id, &Entry::id);
  return found != entries().end() ? std::optional(found->note) : std::nullopt;
}

void NoteBoard::put(quint64 id, const std::optional<DrawnNote>& note) {
  std::vector<Entry>& all = own();
  const auto found = std::ranges::find(all, id, &Entry::id);
  if (found != all.end() && note)
    found->note = *note;
  else if (found != all.end())
    all.erase(found);
  else if (note)
    all.push_back({id, *note});
}

void NoteBoard::push(const QString& text, Before before, Before after) {
  m_undo.push(new Change(this, text, std::move(before), std::move(after)));
}

quint64 NoteBoard::add(const DrawnNote& note) {
  if (entries().size() >= telemetry::DrawnNotes::most) {
    emit notKept(QStringLiteral("There are %1 notes already. Delete some of them first.")
                     .arg(entries().size()));
    return 0;
  }
  m_duration = note.duration;
  const quint64 id = ++m_lastId;
  push(QStringLiteral("Add %1").arg(fromUtf8(nameOf(note.shape))), {{id, std::nullopt}},
       {{id, note}});
  return id;
}

void NoteBoard::change(quint64 id, const DrawnNote& note) {
  const auto before = find(id);
  if (!before || *before == note) return;
  const bool isMoved = before->from != note.from || before->to != note.to;
  m_duration = note.duration;
  push(QStringLiteral("%1 %2").arg(isMoved ? QStringLiteral("Move") : QStringLiteral("Change"),
                                   fromUtf8(nameOf(note.shape))),
       {{id, before}}, {{id, note}});
}

void NoteBoard::remove(const std::vector<quint64>& ids) {
  Before before, after;
  for (const quint64 id : ids) {
    const auto note = find(id);
    if (!note) continue;
    before.emplace_back(id, note);
    after.emplace_back(id, std::nullopt);
  }
  if (before.empty()) return;
  const QString text = before.size() == 1 ? fromUtf8(nameOf(before[0].second->shape))
                                          : QStringLiteral("%1 notes").arg(before.size());
  push(QStringLiteral("Delete %1").arg(text), std::move(before), std::move(after));
}

void NoteBoard::setTool(std::optional<NoteShape> tool) {
  m_tool = tool;
  for (std::size_t i = 0; i < m_tools.size(); ++i) {
    m_tools[i]->setChecked(tool == static_cast<NoteShape>(i));
  }
  emit toolChanged();
}

bool NoteBoard::cancel() {
  if (!m_tool && !m_isHeld) return false;
  m_isHeld = false;
  setTool({});
  emit cancelled();
  return true;
}

void NoteBoard::forget(FrameSource* source) {
  // A recording that goes on keeps the notes that it has.
  if (m_recording != nullptr && m_recording->source() == source) {
    for (const Entry& one : m_of[source]) m_recordedBefore.push_back(one.note);
  }
  m_of[source].clear();
  if (m_shown->source() != source) return;
  listEvents();
  emit changed();
}

void NoteBoard::forgetAfter(FrameSource* source, double time) {
  m_undo.clear();
  std::erase_if(m_of[source], [time](const Entry& one) { return one.note.time > time; });
  changedHere();
}

void NoteBoard::takeRecording() {
  std::vector<Entry>& all = m_of[m_replay];
  all.clear();
  for (const DrawnNote& note : m_replay->drawnNotes()) all.push_back({++m_lastId, note});
  if (m_shown->source() != m_replay) return;
  m_undo.clear();
  listEvents();
  emit changed();
}

void NoteBoard::beginRecorded() {
  m_recordedBefore.clear();
  keep();
}

void NoteBoard::changedHere() {
  listEvents();
  keep();
  emit changed();
}

/// In the timeline, beside what happened in the match.
void NoteBoard::listEvents() {
  std::vector<link::MatchEvent> events;
  for (const Entry& one : entries()) {
    link::MatchEvent& event = events.emplace_back();
    event.kind = link::MatchEventKind::Note;
    event.time = one.note.time;
    event.detail = labelOf(one.note);
  }
  m_shown->events()->replace(link::MatchEventKind::Note, std::move(events));
}

void NoteBoard::keep() {
  FrameSource* source = m_shown->source();
  if (source == m_replay) {
    if (m_replay->isOpen()) write(m_replay->recording().toStdString(), notes());
  }
  if (m_recording == nullptr) return;
  for (const auto& [each, entries] : m_of) {
    if (m_recording->source() != each) continue;
    std::vector<DrawnNote> all = m_recordedBefore;
    for (const Entry& one : entries) all.push_back(one.note);
    write(m_recording->path().toStdString(), std::move(all));
  }
}

void NoteBoard::write(const std::string& session, std::vector<DrawnNote> notes) {
  m_toWrite[session] = std::move(notes);
  writeNext();
}

void NoteBoard::writeNext() {
  if (m_isWriting || m_toWrite.empty()) return;
  m_isWriting = true;
  const auto next = m_toWrite.extract(m_toWrite.begin());
  m_worker.start([this, session = next.key(), notes = next.mapped()] {
    const auto kept = telemetry::writeDrawnNotes(session, notes);
    m_ui.post([this, kept] {
      m_isWriting = false;
      if (!kept) {
        emit notKept(QStringLiteral("The notes will be lost: %1 Open a copy of the recording in a "
                                    "folder that you can write to.")
                         .arg(sentenceOf(kept.error())));
      }
      writeNext();
    });
  });
}

QMenu* addNoteTools(QMenu* menu, const NoteBoard& board) {
  QMenu* tools = menu->addMenu(QStringLiteral("&Draw a note"));
  tools->setObjectName(QStringLiteral("drawNote"));
  for (QAction* tool : board.tools()) tools->addAction(tool);
  return tools;
}

QString titleOf(const DrawnNote& note) {
  static constexpr const char* shapes[] = {"Text", "Arrow", "Circle"};
  return QStringLiteral("%1 on %2")
      .arg(QString::fromUtf8(shapes[static_cast<std::size_t>(note.shape)]),
           note.on.empty() ? QStringLiteral("the field") : fromUtf8(note.on));
}

}  // namespace pitchboard::ui
