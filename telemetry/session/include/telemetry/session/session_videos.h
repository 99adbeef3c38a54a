// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The videos of a session: which file belongs to which time, and where the field is in the picture.
// They are kept in the file of the bookmarks (session_notes.h), with paths relative to it, so that
// they are found again when session and videos are moved together. Times in seconds of the session,
// and of the video since its first picture. Pure functions; any thread.

#include <span>
#include <string>
#include <vector>

#include <base/geometry.h>
#include <base/result.h>

namespace pitchboard::telemetry {

/// A moment of the session that is seen in a picture.
struct VideoAnchor {
  double session = 0.0;  ///< s
  double video = 0.0;    ///< s
  bool operator==(const VideoAnchor&) const = default;
};

/// A point of the field that is seen in the picture.
struct VideoLandmark {
  Point field;    ///< m
  Point picture;  ///< share of width and height, from the top left
  bool operator==(const VideoLandmark&) const = default;
};

struct SessionVideo {
  std::string path;                  ///< of the file
  std::vector<VideoAnchor> anchors;  ///< one, or two if the clocks drift apart
  std::vector<VideoLandmark> landmarks;
  bool operator==(const SessionVideo&) const = default;
};

struct VideoAlignment {
  double offset = 0.0;  ///< s of the session at the first picture
  double rate = 1.0;    ///< seconds of the session for each second of the video

  double sessionTime(double video) const { return offset + rate * video; }
  double videoTime(double session) const { return (session - offset) / rate; }
  bool operator==(const VideoAlignment&) const = default;
};

/// Returns the alignment of one moment, or of two, which give the drift as well; without any, both
/// begin together. Fails with InvalidArgument if two moments contradict each other.
Result<VideoAlignment> alignmentOf(std::span<const VideoAnchor> anchors);

/// Returns the videos of a session; none if there is no file. Their paths are absolute: beside the
/// session where they were when it was kept, or with the same name in its folder, or where they
/// were at all. Fails as readSessionNotes() does.
Result<std::vector<SessionVideo>> readSessionVideos(const std::string& session);
/// Keeps these videos and the bookmarks. Fails as addSessionNote() does.
Result<void> writeSessionVideos(const std::string& session, std::span<const SessionVideo> videos);

}  // namespace pitchboard::telemetry
