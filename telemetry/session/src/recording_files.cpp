// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/recording_files.h>

#include <algorithm>
#include <filesystem>

namespace pitchboard::telemetry {

Result<std::vector<std::string>> recordingsIn(const std::string& folder,
                                              const std::function<bool()>& goOn) {
  namespace fs = std::filesystem;
  std::vector<std::string> out;
  std::error_code error;
  for (fs::recursive_directory_iterator
           at(folder, fs::directory_options::skip_permission_denied, error),
       end;
       !error && at != end; at.increment(error)) {
    if (goOn && !goOn()) break;
    std::error_code unknown;
    if (at->path().extension() == ".mcap" && at->is_regular_file(unknown)) {
      out.push_back(at->path().string());
    }
  }
  if (error) return failure(ErrorCode::SystemError, error.message() + ".", folder);
  std::ranges::sort(out);
  return out;
}

}  // namespace pitchboard::telemetry
