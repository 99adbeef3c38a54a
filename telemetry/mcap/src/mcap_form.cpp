// SPDX-License-Identifier: GPL-3.0-or-later
#include "mcap_form.h"

#include <algorithm>
#include <array>
#include <string>

#include "mcap_bytes.h"

namespace pitchboard::telemetry {
namespace {

using Followers = std::uint16_t;  ///< a bit for each opcode

template <class... Ops>
constexpr Followers anyOf(Ops... ops) {
  return static_cast<Followers>(((1U << static_cast<unsigned>(ops)) | ...));
}

// What a file's parts consist of. The footer ends files that have no DataEnd, too.
constexpr Followers inData =
    anyOf(McapOp::Schema, McapOp::Channel, McapOp::Message, McapOp::Chunk, McapOp::Attachment,
          McapOp::Metadata, McapOp::DataEnd, McapOp::Footer);
constexpr Followers behindChunk = inData | anyOf(McapOp::MessageIndex);
constexpr Followers inSummary =
    anyOf(McapOp::Schema, McapOp::Channel, McapOp::ChunkIndex, McapOp::AttachmentIndex,
          McapOp::Statistics, McapOp::MetadataIndex, McapOp::SummaryOffset, McapOp::Footer);

/// Content is `fixed` bytes, then `texts` parts with a 32-bit length before each, then with `body`
/// one with a 64-bit length, then `behind` bytes; with `open` anything after that.
struct Form {
  Followers next = 0;
  std::uint8_t fixed = 0, texts = 0;
  bool body = false;
  std::uint8_t behind = 0;
  bool open = false;
  std::uint64_t most = 0;  ///< bytes of content
  std::uint8_t step = 1;   ///< what the first text's length is a multiple of

  constexpr std::uint64_t least() const {
    return std::uint64_t{fixed} + std::uint64_t{4} * texts + (body ? 8U : 0U) + behind;
  }
};

constexpr std::uint64_t small = 64U << 20;  // definitions and the summary's records
constexpr std::uint64_t large = std::uint64_t{1} << 40;

constexpr std::array<Form, 16> forms{{
    {},
    /* Header */ {inData, 0, 2, false, 0, false, small},
    /* Footer */ {0, 20, 0, false, 0, false, 20},
    /* Schema */ {inData, 2, 3, false, 0, false, small},
    /* Channel */ {inData, 4, 3, false, 0, false, small},
    /* Message */ {inData, 22, 0, false, 0, true, large},
    /* Chunk */ {behindChunk, 28, 1, true, 0, false, large},
    /* MessageIndex */ {behindChunk, 2, 1, false, 0, false, large, 16},
    /* ChunkIndex */ {inSummary, 64, 0, false, 0, true, small},
    /* Attachment */ {inData, 16, 2, true, 4, false, large},
    /* AttachmentIndex */ {inSummary, 40, 2, false, 0, false, small},
    /* Statistics */ {inSummary, 42, 1, false, 0, false, small},
    /* Metadata */ {inData, 0, 2, false, 0, false, small},
    /* MetadataIndex */ {inSummary, 16, 1, false, 0, false, small},
    /* SummaryOffset */ {inSummary, 17, 0, false, 0, false, 17},
    /* DataEnd */ {inSummary, 4, 0, false, 0, false, 4},
}};

const Form& formOf(McapOp op) {
  const auto number = static_cast<std::size_t>(op);
  return forms[number < forms.size() ? number : 0];
}

}  // namespace

RecordHead headIn(std::string_view bytes) {
  RecordReader in(bytes);
  RecordHead head;
  head.op = static_cast<McapOp>(in.number<std::uint8_t>());
  head.length = in.number<std::uint64_t>();
  head.whole = in.ok();
  return head;
}

bool isKnownRecord(McapOp op) {
  return op != McapOp{0} && static_cast<std::size_t>(op) < forms.size();
}

bool mayFollow(McapOp before, McapOp op) {
  return isKnownRecord(op) && (formOf(before).next >> static_cast<unsigned>(op) & 1U) != 0;
}

bool lengthFits(McapOp op, std::uint64_t length) {
  const Form& form = formOf(op);
  return length >= form.least() && length <= form.most && (length - form.least()) % form.step == 0;
}

bool formFits(McapOp op, std::string_view beginning, std::uint64_t length) {
  if (!lengthFits(op, length)) return false;
  const Form& form = formOf(op);
  if (form.open) return true;
  std::uint64_t at = form.fixed;
  const auto pass = [&](auto size) {
    if (at > beginning.size()) return false;
    RecordReader in(beginning.substr(static_cast<std::size_t>(at)));
    size = in.number<decltype(size)>();
    at += sizeof size;
    if (!in.ok() || at > length || size > length - at) return false;
    at += size;
    return true;
  };
  for (int i = 0; i < form.texts; ++i) {
    if (!pass(std::uint32_t{})) return false;
  }
  if (form.body && !pass(std::uint64_t{})) return false;
  return length - at == form.behind;
}

bool mayEnd(const McapSource& source, std::uint64_t at, McapOp before) {
  if (at >= source.size()) return at == source.size();
  const std::uint64_t left = source.size() - at;
  std::string bytes;
  if (!source.read(at, static_cast<std::size_t>(std::min<std::uint64_t>(left, recordHead)),
                   bytes)) {
    return false;
  }
  const RecordHead head = headIn(bytes);
  if (head.op == McapOp{0} || isKnownRecord(head.op)) {
    return mayFollow(before, head.op) && (!head.whole || lengthFits(head.op, head.length));
  }
  return head.whole && head.length <= left - recordHead;
}

std::optional<McapFooter> footerOf(const McapSource& source) {
  constexpr std::size_t tail = recordHead + footerLength + mcapMagic.size();
  std::string bytes;
  if (source.size() < tail || !source.read(source.size() - tail, tail, bytes)) return {};
  RecordReader in(bytes);
  const auto op = static_cast<McapOp>(in.number<std::uint8_t>());
  const auto length = in.number<std::uint64_t>();
  McapFooter footer;
  footer.offset = source.size() - tail;
  footer.summary = in.number<std::uint64_t>();
  in.number<std::uint64_t>();
  footer.crc = in.number<std::uint32_t>();
  if (op != McapOp::Footer || length != footerLength ||
      in.bytes(mcapMagic.size()) != std::string_view(mcapMagic.data(), mcapMagic.size())) {
    return {};
  }
  return footer;
}

bool dataEndsAt(const McapSource& source, std::uint64_t at) {
  const std::uint64_t end = at + recordHead + 4;
  if (mayEnd(source, end, McapOp::DataEnd)) return true;
  const auto footer = footerOf(source);
  return footer && footer->summary == end;
}

}  // namespace pitchboard::telemetry
