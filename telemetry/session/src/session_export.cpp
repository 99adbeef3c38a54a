// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_export.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>

#include <base/csv_field.h>
#include <base/new_file.h>
#include <telemetry/series/group_order.h>

#include "export_even.h"
#include "export_text.h"
#include "session_copy.h"
#include "session_format.h"

namespace pitchboard::telemetry {
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
      : m_session(session),
        m_selection(selection),
        m_selected(selected),
        m_listed(listedOrder(session.groups(), &SessionGroup::info)),
        m_out(out) {}
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
  /// The variables' names, one for each column; how many.
  std::size_t putNames() {
    std::size_t columns = 0;
    for (const std::size_t g : m_listed) {
      if (!m_selected[g].selected) continue;
      for (const SelectedColumn& column : m_selected[g].columns) {
        m_out.putSafely("," + csvField(info(g).name + "." + info(g).columns[column.column].name));
      }
      columns += m_selected[g].columns.size();
    }
    return columns;
  }
  /// A value; `room` is what the line needs behind it. False: it has no label, nothing was put.
  bool putLabel(const SelectedColumn& column, double value, std::size_t room, bool json) {
    const std::string* word = column.labelOf(value);
    if (word == nullptr) return false;
    m_out.putSafely(json ? quoted(*word) : csvField(*word));
    m_out.reserve(room);
    return true;
  }
  static constexpr std::size_t clockRoom = 40;
  const SessionReader& m_session;
  const ExportSelection& m_selection;
  const Selected& m_selected;
  const std::vector<std::size_t> m_listed;  // groups, in the order of columns
  TextBuffer& m_out;
  Cell m_time;
};

class WideWriter : public LineWriter {
 public:
  using LineWriter::LineWriter;

  bool begin() override {
    m_parts.resize(m_selected.size());
    for (std::size_t g = 0; g < m_selected.size(); ++g) {
      if (m_selected[g].selected) m_parts[g].cells.resize(m_selected[g].columns.size());
    }
    m_out.putSafely(timeHead());
    m_longestLine = putNames() * (Cell::room + 1);
    return m_out.endLine();
  }

  bool row(const SessionItem& item) override {
    Part& part = m_parts[item.group];
    const auto bits = std::bit_cast<std::uint64_t>(item.time);
    if (m_open && (bits != m_bits || part.filled) && !line()) return false;
    m_open = true;
    m_bits = bits;
    part.filled = true;
    const auto& columns = m_selected[item.group].columns;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      part.cells[i].set(columns[i].type, bitsOf(columns[i], item.row));
    }
    return true;
  }

  bool end() override { return !m_open || line(); }

 protected:
  struct Part {
    std::vector<Cell> cells;
    bool filled = false;
  };

  bool line() {
    m_open = false;
    putTime(std::bit_cast<double>(m_bits), m_longestLine);
    for (const std::size_t g : m_listed) {
      Part& part = m_parts[g];
      for (std::size_t i = 0; i < part.cells.size(); ++i) {
        m_out.put(',');
        if (part.filled) put(m_selected[g].columns[i], part.cells[i]);
      }
      part.filled = false;
    }
    return m_out.endLine();
  }

  void put(const SelectedColumn& column, const Cell& cell) {
    if (column.labels == nullptr) {
      if (!m_holesAreEmpty || cell.isNumber()) m_out.put(cell);
    } else {
      putLabel(column, std::bit_cast<double>(cell.bits), m_longestLine, false);
    }
  }

  std::vector<Part> m_parts;
  std::size_t m_longestLine = 0;
  bool m_holesAreEmpty = false;
  std::uint64_t m_bits = 0;
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
        m_out.put(cell);
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
        m_rows(session, selected, selection.resampling) {
    m_holesAreEmpty = true;
  }

  bool row(const SessionItem& item) override { return m_rows.add(item, m_write); }
  bool end() override { return m_rows.end(m_write); }

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
  const auto selected = resolveSelection(session, selection);
  if (!selected) return tl::unexpected(selected.error());
  TextBuffer out(sink);
  std::unique_ptr<LineWriter> writer;
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
          selection.resampling.rate > Resampling::mostPerSecond) {
        return failure(ErrorCode::InvalidArgument,
                       "The rate must be above 0 and at most 10000 lines a second.");
      }
      writer = std::make_unique<EvenWriter>(session, selection, *selected, out);
      break;
    case ExportFormat::Mcap:
      return failure(ErrorCode::InvalidArgument,
                     "A session cannot be written as text. Choose a file.");
  }
  bool going = writer->begin();
  bool interrupted = false;
  const auto visit = [&](const SessionItem& item) {
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
    going = going && session.walk(selection.range, visit, report);
  } else {
    going = going && session.walkRows(selection.range, visit, report);
  }
  if (interrupted) return exportStopped();
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
    const auto copied = copySession(session, selection, std::move(*file),
                                    {"", session.file().contents().library, 3, false}, progress);
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
  return report;
}

}  // namespace pitchboard::telemetry
