// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_export.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include <base/byte_sizes.h>
#include <base/csv_field.h>
#include <base/new_file.h>
#include <base/try.h>
#include <telemetry/series/group_order.h>
#include <telemetry/session/drawn_notes.h>

#include "export_even.h"
#include "export_selection.h"
#include "session_copy.h"
#include "session_format.h"

namespace pitchboard::telemetry {

/// Text of one value, and the bits that it stands for.
struct Cell {
  static constexpr std::size_t room = 32;  ///< no double needs more than 24
  std::array<char, room> text{};
  std::uint32_t length = 0;
  bool filled = false;
  std::uint64_t bits = 0;

  void set(ColumnType type, std::uint64_t newBits) {
    if (filled && bits == newBits) return;
    filled = true;
    bits = newBits;
    char* const end = text.data() + room;
    std::to_chars_result done{};
    switch (type) {
      case ColumnType::Int32:
        done = std::to_chars(text.data(), end,
                             std::bit_cast<std::int32_t>(static_cast<std::uint32_t>(newBits)));
        break;
      case ColumnType::Float32:
        done = std::to_chars(text.data(), end,
                             std::bit_cast<float>(static_cast<std::uint32_t>(newBits)));
        break;
      case ColumnType::Float64:
        done = std::to_chars(text.data(), end, std::bit_cast<double>(newBits));
        break;
    }
    length = static_cast<std::uint32_t>(done.ptr - text.data());
  }
  /// NaN if the value is unknown.
  bool isUnknown() const { return length >= 3 && text[length - 1] == 'n'; }
  /// Not unknown nor infinite: JSON cannot express them.
  bool isNumber() const {
    const char last = length > 0 ? text[length - 1] : 'n';
    return last >= '0' && last <= '9';
  }
};

std::uint64_t bitsOf(const SelectedColumn& column, const RowView& row) {
  return column.type == ColumnType::Float64 ? std::bit_cast<std::uint64_t>(row.values[column.index])
                                            : row.words[column.index];
}

/// A buffer that grows by pieces of known greatest length and is handed on when it is large.
class TextBuffer {
 public:
  explicit TextBuffer(const std::function<bool(std::string_view)>& sink) : m_sink(sink) {
    m_text.resize(flushAt + 4096);
  }
  /// Room for `bytes` more.
  void reserve(std::size_t bytes) {
    if (m_used + bytes > m_text.size()) m_text.resize((m_used + bytes) * 2);
  }
  /// After reserve(Cell::room): copies a fixed count of bytes, which is one instruction or two.
  void put(const Cell& cell) {
    std::memcpy(m_text.data() + m_used, cell.text.data(), Cell::room);
    m_used += cell.length;
  }
  void put(char c) { m_text[m_used++] = c; }
  void put(std::string_view text) {
    std::memcpy(m_text.data() + m_used, text.data(), text.size());
    m_used += text.size();
  }
  void putSafely(std::string_view text) {
    reserve(text.size());
    put(text);
  }
  bool endLine() {
    reserve(1);
    put('\n');
    ++m_lines;
    return m_used < flushAt || flush();
  }
  bool flush() {
    m_bytes += m_used;
    const bool taken = m_used == 0 || m_sink(std::string_view(m_text).substr(0, m_used));
    m_used = 0;
    m_failed = m_failed || !taken;
    return taken;
  }
  bool failed() const { return m_failed; }
  std::uint64_t bytes() const { return m_bytes; }
  std::uint64_t lines() const { return m_lines; }

 private:
  static constexpr std::size_t flushAt = 256 * kibibyte;
  const std::function<bool(std::string_view)>& m_sink;
  std::string m_text;
  std::size_t m_used = 0;
  std::uint64_t m_bytes = 0, m_lines = 0;
  bool m_failed = false;
};

namespace {

using Selected = std::vector<SelectedGroup>;

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// UTC, with milliseconds.
std::string clockText(WallTime start, double seconds) {
  const double shown = std::clamp(seconds, -1e9, 1e9);
  const auto at = std::chrono::floor<std::chrono::milliseconds>(
      start + Duration(static_cast<std::int64_t>(std::round(shown * 1e9))));
  const auto whole = std::chrono::floor<std::chrono::seconds>(at);
  const std::time_t time = std::chrono::system_clock::to_time_t(whole);
  std::tm parts{};
  char text[40];
  if (!gmtime_r(&time, &parts)) return {};
  std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d:%02d.%03dZ",
                (parts.tm_year + 1900) % 10'000, parts.tm_mon + 1, parts.tm_mday, parts.tm_hour,
                parts.tm_min, parts.tm_sec, static_cast<int>((at - whole).count()));
  return text;
}

/// What a format does with the things of a session. Every function says false to stop.
class LineWriter {
 public:
  LineWriter(const SessionReader& session, const ExportSelection& selection,
             const Selected& selected, TextBuffer& out)
      : m_session(session), m_selection(selection), m_selected(selected), m_out(out) {}
  virtual ~LineWriter() = default;
  virtual bool begin() { return true; }
  virtual bool row(const SessionItem& item) = 0;
  virtual bool message(const SessionItem&) { return true; }
  virtual bool end() { return true; }

 protected:
  const GroupInfo& info(std::size_t group) const { return m_session.groups()[group].info; }
  /// "time" and, where it is wanted, "clock".
  std::string timeHead() const { return m_selection.clock ? "time,clock" : "time"; }
  /// Both of them. A line has `room` more.
  void putTime(double time, std::size_t room) {
    m_time.set(ColumnType::Float64, std::bit_cast<std::uint64_t>(time));
    m_out.reserve(room + Cell::room + clockRoom);
    m_out.put(m_time);
    if (!m_selection.clock) return;
    m_out.put(',');
    m_out.put(clockText(m_session.info().start, time));
  }
  /// A value; `room` is what the line needs behind it. False: it has no label, nothing was put.
  bool putLabel(const SelectedColumn& column, double value, std::size_t room, bool json) {
    const std::string* word = column.labelOf(value);
    if (word == nullptr) return false;
    m_out.putSafely(json ? quoted(*word) : csvField(*word));
    m_out.reserve(room);
    return true;
  }
  /// A number of CSV; a cell is empty where the value is unknown.
  void putValue(const Cell& cell) {
    if (!cell.isUnknown()) m_out.put(cell);
  }
  static constexpr std::size_t clockRoom = 40;
  const SessionReader& m_session;
  const ExportSelection& m_selection;
  const Selected& m_selected;
  TextBuffer& m_out;
  Cell m_time;
};

class WideWriter : public LineWriter {
 public:
  using LineWriter::LineWriter;

  bool begin() override {
    m_parts.resize(m_selected.size());
    for (const std::size_t g : listedOrder(m_session.groups(), &SessionGroup::info)) {
      if (!m_selected[g].selected) continue;
      m_parts[g].cells.resize(m_selected[g].columns.size());
      for (std::size_t i = 0; i < m_parts[g].cells.size(); ++i) {
        m_places.push_back({g, &m_selected[g].columns[i], &m_parts[g], &m_parts[g].cells[i]});
      }
    }
    // Robots stand side by side, but first of all the order is that of the selection.
    std::ranges::stable_sort(m_places, {}, [](const Place& place) { return place.column->wanted; });
    m_out.putSafely(timeHead());
    for (const Place& place : m_places) {
      const ColumnInfo& column = info(place.group).columns[place.column->column];
      m_out.putSafely("," + csvField(info(place.group).name + "." + column.name));
    }
    m_maxLineLength = m_places.size() * (Cell::room + 1);
    return m_out.endLine();
  }

  bool row(const SessionItem& item) override {
    const auto bits = std::bit_cast<std::uint64_t>(item.time);
    if (m_open && bits != m_bits && !lines()) return false;
    m_open = true;
    m_bits = bits;
    const auto& columns = m_selected[item.group].columns;
    Part& part = m_parts[item.group];
    if (part.filled) {
      // A second row of this time: the n-th rows of all robots share a line.
      Later later{item.group, {}};
      for (const SelectedColumn& column : columns) later.bits.push_back(bitsOf(column, item.row));
      m_later.push_back(std::move(later));
      return true;
    }
    part.filled = true;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      part.cells[i].set(columns[i].type, bitsOf(columns[i], item.row));
    }
    return true;
  }

  bool end() override { return !m_open || lines(); }

 protected:
  struct Part {
    std::vector<Cell> cells;
    bool filled = false;
  };

  bool line() {
    putTime(std::bit_cast<double>(m_bits), m_maxLineLength);
    for (const Place& place : m_places) {
      m_out.put(',');
      if (place.part->filled) put(*place.column, *place.cell);
    }
    for (Part& part : m_parts) part.filled = false;
    return m_out.endLine();
  }

  std::vector<Part> m_parts;
  std::uint64_t m_bits = 0;  // of the line's time

 private:
  struct Place {
    std::size_t group;
    const SelectedColumn* column;
    const Part* part;
    const Cell* cell;
  };
  struct Later {
    GroupId group;
    std::vector<std::uint64_t> bits;
  };

  /// All lines of one time.
  bool lines() {
    m_open = false;
    if (!line()) return false;
    while (!m_later.empty()) {
      std::vector<Later> rest;
      for (Later& later : m_later) {
        Part& part = m_parts[later.group];
        if (part.filled) {
          rest.push_back(std::move(later));
          continue;
        }
        part.filled = true;
        const auto& columns = m_selected[later.group].columns;
        for (std::size_t i = 0; i < columns.size(); ++i) {
          part.cells[i].set(columns[i].type, later.bits[i]);
        }
      }
      m_later = std::move(rest);
      if (!line()) return false;
    }
    return true;
  }

  void put(const SelectedColumn& column, const Cell& cell) {
    if (column.labels == nullptr) {
      putValue(cell);
    } else {
      putLabel(column, std::bit_cast<double>(cell.bits), m_maxLineLength, false);
    }
  }

  std::vector<Place> m_places;  // in the order of columns
  std::vector<Later> m_later;   // rows of the open time that need lines of their own
  std::size_t m_maxLineLength = 0;
  bool m_open = false;
};

/// Shared by the forms that name robot and variable in every line.
class NamedWriter : public LineWriter {
 public:
  using LineWriter::LineWriter;

 protected:
  void prepare(const std::function<std::string(const GroupInfo&, const ColumnInfo&)>& prefix) {
    m_cells.resize(m_selected.size());
    m_prefixes.resize(m_selected.size());
    for (std::size_t g = 0; g < m_selected.size(); ++g) {
      m_cells[g].resize(m_selected[g].columns.size());
      for (const SelectedColumn& column : m_selected[g].columns) {
        m_prefixes[g].push_back(prefix(info(g), info(g).columns[column.column]));
      }
    }
  }
  std::vector<std::vector<Cell>> m_cells;
  std::vector<std::vector<std::string>> m_prefixes;
};

class LongWriter : public NamedWriter {
 public:
  using NamedWriter::NamedWriter;

  bool begin() override {
    prepare([](const GroupInfo& group, const ColumnInfo& column) {
      return "," + csvField(group.name) + "," + csvField(column.name) + ",";
    });
    m_out.putSafely(timeHead() + ",robot,variable,value");
    return m_out.endLine();
  }

  bool row(const SessionItem& item) override {
    const auto& columns = m_selected[item.group].columns;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      Cell& cell = m_cells[item.group][i];
      const std::string& prefix = m_prefixes[item.group][i];
      cell.set(columns[i].type, bitsOf(columns[i], item.row));
      putTime(item.time, Cell::room + prefix.size());
      m_out.put(prefix);
      if (columns[i].labels == nullptr) {
        putValue(cell);
      } else {
        putLabel(columns[i], std::bit_cast<double>(cell.bits), 1, false);
      }
      if (!m_out.endLine()) return false;
    }
    return true;
  }
};

/// As WideWriter, at even times.
class EvenWriter : public WideWriter {
 public:
  EvenWriter(const SessionReader& session, const ExportSelection& selection,
             const Selected& selected, TextBuffer& out)
      : WideWriter(session, selection, selected, out),
        m_rows(session, selected, selection.resampling, selection.range) {}

  bool row(const SessionItem& item) override { return m_rows.add(item, m_write); }
  bool end() override { return m_rows.end(m_write); }
  const EvenRows& rows() const { return m_rows; }

 private:
  bool put(double time, const EvenLine& values) {
    m_bits = std::bit_cast<std::uint64_t>(time);
    auto value = values.begin();
    for (Part& part : m_parts) {
      part.filled = true;
      for (Cell& cell : part.cells) {
        cell.set(ColumnType::Float64, std::bit_cast<std::uint64_t>(*value++));
      }
    }
    return line();
  }

  EvenRows m_rows;
  const EvenRows::Write m_write = [this](double time, const EvenLine& line) {
    return put(time, line);
  };
};

class JsonWriter : public NamedWriter {
 public:
  using NamedWriter::NamedWriter;

  bool begin() override {
    prepare([](const GroupInfo&, const ColumnInfo& column) { return quoted(column.name) + ":"; });
    for (std::size_t g = 0; g < m_selected.size(); ++g) {
      m_heads.push_back(",\"robot\":" + quoted(info(g).name) + ",\"values\":{");
    }
    return true;
  }

  bool row(const SessionItem& item) override {
    beginLine(item.time);
    m_out.putSafely(m_heads[item.group]);
    const auto& columns = m_selected[item.group].columns;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      Cell& cell = m_cells[item.group][i];
      const std::string& prefix = m_prefixes[item.group][i];
      cell.set(columns[i].type, bitsOf(columns[i], item.row));
      m_out.reserve(Cell::room + prefix.size() + 8);
      if (i > 0) m_out.put(',');
      m_out.put(prefix);
      const bool isWord = putLabel(columns[i], std::bit_cast<double>(cell.bits), 8, true);
      if (isWord) continue;
      if (columns[i].labels == nullptr && cell.isNumber())
        m_out.put(cell);
      else
        m_out.put("null");
    }
    m_out.putSafely("}}");
    return m_out.endLine();
  }

  bool message(const SessionItem& item) override {
    // A message of another program may have line ends in it.
    std::string json(item.message->data);
    std::replace(json.begin(), json.end(), '\n', ' ');
    std::replace(json.begin(), json.end(), '\r', ' ');
    beginLine(item.time);
    m_out.putSafely(
        ",\"stream\":\"" +
        std::string(session::streams[static_cast<std::size_t>(item.stream)].topic.substr(1)) +
        "\",\"message\":");
    m_out.putSafely(json);
    m_out.putSafely("}");
    return m_out.endLine();
  }

 private:
  void beginLine(double time) {
    m_time.set(ColumnType::Float64, std::bit_cast<std::uint64_t>(time));
    m_out.reserve(64);
    m_out.put("{\"time\":");
    m_out.put(m_time);
  }
  std::vector<std::string> m_heads;
};

}  // namespace

Result<ExportReport> exportText(const SessionReader& session, ExportFormat format,
                                const ExportSelection& selection,
                                const std::function<bool(std::string_view)>& sink,
                                const ExportProgress& progress) {
  auto selected = resolveSelection(session, selection);
  if (!selected) return tl::unexpected(selected.error());
  for (SelectedGroup& group : *selected) {
    std::ranges::stable_sort(group.columns, {}, &SelectedColumn::wanted);
  }
  TextBuffer out(sink);
  std::unique_ptr<LineWriter> writer;
  const EvenRows* even = nullptr;
  switch (format) {
    case ExportFormat::CsvWide:
      writer = std::make_unique<WideWriter>(session, selection, *selected, out);
      break;
    case ExportFormat::CsvLong:
      writer = std::make_unique<LongWriter>(session, selection, *selected, out);
      break;
    case ExportFormat::JsonLines:
      writer = std::make_unique<JsonWriter>(session, selection, *selected, out);
      break;
    case ExportFormat::CsvEven:
      if (!(selection.resampling.rate > 0.0) ||
          selection.resampling.rate > Resampling::maxPerSecond) {
        return failure(ErrorCode::InvalidArgument,
                       "The rate must be above 0 and at most 10000 lines a second.");
      }
      if (auto made = std::make_unique<EvenWriter>(session, selection, *selected, out)) {
        even = &made->rows();
        writer = std::move(made);
      }
      break;
    case ExportFormat::Mcap:
      return failure(ErrorCode::InvalidArgument,
                     "A session cannot be written as text. Choose a file.");
  }
  bool going = writer->begin();
  bool interrupted = false;
  std::vector<SessionEvent> events;  // with bookmarks as their notes were written last
  if (format == ExportFormat::JsonLines && selection.messages) events = session.events();
  const auto isOldNote = [&events](const SessionItem& item) {
    if (item.stream != SessionStream::Events) return false;
    const auto event = session::eventFromJson(item.message->data);
    return event && event->kind == session::bookmarkKind &&
           std::ranges::none_of(events, [&](const SessionEvent& known) {
             constexpr double sameTime = 1e-6;  // s; files keep whole nanoseconds
             return known.kind == event->kind && known.text == event->text &&
                    std::abs(known.time - item.time) < sameTime;
           });
  };
  const auto visit = [&](const SessionItem& item) {
    if (!item.isRow && isOldNote(item)) return true;
    if (!item.isRow && selection.change) {
      std::string json(item.message->data);
      if (!selection.change(item.stream, json)) return true;
      McapMessage changed = *item.message;
      changed.data = json;
      SessionItem other = item;
      other.message = &changed;
      return writer->message(other);
    }
    if (!item.isRow) return writer->message(item);
    return !(*selected)[item.group].selected || writer->row(item);
  };
  const auto report = [&](double part) {
    interrupted = progress && !progress(part);
    return !interrupted;
  };
  if (format == ExportFormat::JsonLines && selection.messages) {
    // The bookmarks beside the file stand among its messages.
    auto note = session.addedNotes().begin();
    const auto notesBefore = [&](double time) {
      for (; note != session.addedNotes().end() && note->time < time; ++note) {
        if (note->time < selection.range.begin || note->time > selection.range.end) continue;
        const std::string json = session::toJson(*note);
        const std::uint64_t at = session.logTime(note->time);
        const McapMessage message{0, 0, at, at, json};
        SessionItem item;
        item.time = note->time;
        item.message = &message;
        if (!visit(item)) return false;
      }
      return true;
    };
    going = going &&
            session.walk(
                selection.range,
                [&](const SessionItem& item) { return notesBefore(item.time) && visit(item); },
                report) &&
            notesBefore(1e18);
  } else {
    going = going &&
            session.walkRows(even != nullptr ? even->needed() : selection.range, visit, report);
  }
  if (interrupted) return exportStopped();
  going = going || (even != nullptr && even->isDone() && !out.failed());
  going = going && writer->end() && out.flush();
  if (!going) {
    return failure(ErrorCode::SystemError, "The export cannot be written.");
  }
  return ExportReport{out.lines(), out.bytes()};
}

Result<ExportReport> exportFile(const SessionReader& session, ExportFormat format,
                                const ExportSelection& selection, const std::string& path,
                                const ExportProgress& progress, IfExists ifExists) {
  const auto selected = resolveSelection(session, selection);
  if (!selected) return tl::unexpected(selected.error());
  auto target = FileTarget::at(path, ifExists, session.file().contents().name);
  if (!target) return tl::unexpected(target.error());
  auto file = target->open();
  if (!file) return tl::unexpected(file.error());
  Result<ExportReport> report;
  if (format == ExportFormat::Mcap) {
    const auto copied =
        copySession(session, selection, std::move(*file),
                    {"", session.file().contents().library, 3, false}, progress, false);
    if (!copied) return tl::unexpected(copied.error());
    report->bytes = copied->bytes;
    for (const auto& [id, digest] : copied->channels) report->lines += digest.messages;
  } else {
    Result<void> written;
    report = exportText(
        session, format, selection,
        [&](std::string_view text) {
          written = file->write(text);
          return written.has_value();
        },
        progress);
    if (!written) report = tl::unexpected(written.error());
    if (auto closed = file->close(); report && !closed) report = tl::unexpected(closed.error());
  }
  if (!report) return report;
  if (auto named = target->commit(); !named) return tl::unexpected(named.error());
  if (format == ExportFormat::Mcap && selection.messages) {
    TRY(copyDrawnNotes(session.file().contents().name, path, selection.range));
  }
  return report;
}

}  // namespace pitchboard::telemetry
