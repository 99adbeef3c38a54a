// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a session file: opened by its summary and by walking, looked at, exported.
#include <cstdlib>

#include <telemetry/session/session_export.h>
#include <telemetry/session/session_reader.h>

using namespace pitchboard::telemetry;

namespace {

void lookAt(const std::string& bytes, bool walk) {
  McapReaderOptions options;
  options.maxChunkBytes = 1 << 20;
  options.maxAttachmentBytes = 1 << 20;
  options.ignoreSummary = walk;
  const auto session = SessionReader::openBytes(bytes, options);
  if (!session) return;
  std::vector<SessionRow> rows;
  const auto range = session->range();
  for (const double time :
       {-1.0, 0.0, range ? range->begin : 1.0, range ? range->end : 2.0, 1e300}) {
    session->rowsAt(time, rows);
    if (rows.size() != session->groups().size()) std::abort();
    for (std::size_t g = 0; g < rows.size(); ++g) {
      const GroupInfo& info = session->groups()[g].info;
      if (rows[g].present && rows[g].words.size() + rows[g].values.size() != info.columns.size()) {
        std::abort();
      }
    }
  }
  (void)session->events();
  session->messages(SessionStream::Telemetry, {-1e18, 1e18}, [](double, std::string_view json) {
    (void)sessionDatagram(json);
    return true;
  });
  for (const auto& attachment : session->file().contents().attachments)
    (void)session->attachment(attachment.name);
  if (walk) return;
  std::size_t written = 0;
  for (const auto format : {ExportFormat::CsvWide, ExportFormat::JsonLines}) {
    (void)exportText(*session, format, {}, [&](std::string_view text) {
      written += text.size();
      return written < 4'000'000;
    });
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  lookAt(bytes, false);
  lookAt(bytes, true);
  return 0;
}
