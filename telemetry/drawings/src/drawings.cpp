// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/drawings/drawings.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <telemetry/formats/text_decoder.h>
#include <telemetry/formats/text_errors.h>

namespace pitchboard::telemetry {
namespace {

using Limits = DrawingLimits;

constexpr std::string_view magic = "PBD1 ";
constexpr std::string_view blanks = " \t\r";

struct ShapeName {
  std::string_view token;
  ShapeKind kind;
  std::string_view needs;
};
constexpr std::array<ShapeName, 8> shapeNames{{
    {"line", ShapeKind::Line, "x y of at least two points"},
    {"arrow", ShapeKind::Arrow, "x y of at least two points; its head is at the last"},
    {"circle", ShapeKind::Circle, "x, y and the radius"},
    {"disc", ShapeKind::Disc, "x, y and the radius"},
    {"polygon", ShapeKind::Polygon, "x y of at least three points"},
    {"area", ShapeKind::Area, "x y of at least three points"},
    {"point", ShapeKind::Point, "x and y"},
    {"text", ShapeKind::Text, "x, y and the text"},
}};

struct ColourName {
  std::string_view token;
  std::uint32_t value;
};
constexpr std::array<ColourName, 14> colourNames{{{"white", 0xffffffff},
                                                  {"black", 0xff000000},
                                                  {"grey", 0xff9aa0a6},
                                                  {"gray", 0xff9aa0a6},
                                                  {"red", 0xffe5484d},
                                                  {"orange", 0xfff2871f},
                                                  {"yellow", 0xfff5d90a},
                                                  {"green", 0xff46c265},
                                                  {"cyan", 0xff22c3d6},
                                                  {"blue", 0xff4c8dff},
                                                  {"violet", 0xff9d6bff},
                                                  {"magenta", 0xffe255c8},
                                                  {"pink", 0xffff9ec7},
                                                  {"brown", 0xffa9754f}}};

constexpr std::array<std::string_view, 3> frameNames{"field", "robot", "belief"};

/// The tokens of one line.
class LineTokens {
 public:
  explicit LineTokens(std::string_view line) : m_rest(line) {}
  /// Empty at the end.
  std::string_view next() {
    skip();
    const std::size_t end = std::min(m_rest.find_first_of(blanks), m_rest.size());
    const std::string_view token = m_rest.substr(0, end);
    m_rest.remove_prefix(end);
    return token;
  }
  /// What is left, without blanks round it.
  std::string_view rest() {
    skip();
    const std::size_t last = m_rest.find_last_not_of(blanks);
    return last == std::string_view::npos ? std::string_view() : m_rest.substr(0, last + 1);
  }

 private:
  void skip() { m_rest.remove_prefix(std::min(m_rest.find_first_not_of(blanks), m_rest.size())); }
  std::string_view m_rest;
};

std::optional<double> number(std::string_view token, double most) {
  if (token.starts_with('+')) token.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc{} || end != token.data() + token.size() || !(std::abs(value) <= most)) {
    return std::nullopt;
  }
  return value;
}

std::optional<int> whole(std::string_view token, int most) {
  int value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc{} || end != token.data() + token.size() || value < 1 || value > most) {
    return std::nullopt;
  }
  return value;
}

std::optional<std::uint32_t> hexColour(std::string_view token) {
  if (!token.starts_with('#') || (token.size() != 7 && token.size() != 9)) return std::nullopt;
  std::uint32_t value = 0;
  const auto [end, error] =
      std::from_chars(token.data() + 1, token.data() + token.size(), value, 16);
  if (error != std::errc{} || end != token.data() + token.size()) return std::nullopt;
  // Written #rrggbbaa, kept 0xAARRGGBB.
  return token.size() == 7 ? 0xff000000U | value : (value >> 8U) | (value << 24U);
}

std::string quotedToken(std::string_view token) {
  return "\"" + printable(token, 40) + "\"";
}

class DrawingReader {
 public:
  explicit DrawingReader(std::string_view text) : m_rest(text) {}

  Result<Drawing> read() {
    std::string_view line;
    nextLine(line);
    if (auto good = readHead(line); !good) return atLine(good.error());
    while (nextLine(line)) {
      if (auto good = readLine(line); !good) return atLine(good.error());
    }
    return std::move(m_drawing);
  }

 private:
  static tl::unexpected<Error> refuse(std::string sentence) {
    return failure(ErrorCode::ParseError, std::move(sentence));
  }
  tl::unexpected<Error> atLine(Error error) const {
    error.context = "drawing, line " + std::to_string(m_line);
    return tl::unexpected(std::move(error));
  }
  bool nextLine(std::string_view& line) {
    if (m_rest.empty()) return false;
    const std::size_t end = std::min(m_rest.find('\n'), m_rest.size());
    line = m_rest.substr(0, end);
    m_rest.remove_prefix(std::min(end + 1, m_rest.size()));
    ++m_line;
    return true;
  }

  Result<void> readHead(std::string_view line) {
    if (!line.starts_with(magic)) {
      return refuse("a drawing begins with PBD1 and the robot's number, for example \"PBD1 3\"");
    }
    LineTokens tokens(line.substr(magic.size()));
    const auto robot = whole(tokens.next(), TextDecoder::maxRobot);
    if (!robot) {
      return refuse("PBD1 must be followed by the robot's number, from 1 to " +
                    std::to_string(TextDecoder::maxRobot));
    }
    m_drawing.robot = *robot;
    const std::string_view team = tokens.next();
    if (team.empty()) return {};
    constexpr int highestTeam = 65535;
    m_drawing.team = whole(team, highestTeam);
    if (!m_drawing.team || !tokens.rest().empty()) {
      return refuse("only the team's number may follow the robot's number");
    }
    return {};
  }

  Result<void> readLine(std::string_view line) {
    LineTokens tokens(line);
    const std::string_view token = tokens.next();
    if (token.empty()) return {};
    if (token == "layer" || token == "more") return readLayer(tokens, token == "more");
    if (token == "colour" || token == "color") return readColour(tokens);
    if (token == "width") return readWidth(tokens);
    const auto shape = std::ranges::find(shapeNames, token, &ShapeName::token);
    if (shape == shapeNames.end()) {
      return refuse(quotedToken(token) +
                    " is not one of layer, more, colour, width, line, arrow, circle, disc, "
                    "polygon, area, point, text");
    }
    if (m_drawing.layers.empty()) {
      return refuse("there is no layer yet: begin with \"layer NAME\"");
    }
    return readShape(*shape, tokens);
  }

  Result<void> readLayer(LineTokens& tokens, bool adds) {
    if (m_drawing.layers.size() == Limits::layers) {
      return refuse("a datagram has at most " + std::to_string(Limits::layers) + " layers");
    }
    DrawingLayer layer;
    layer.adds = adds;
    const std::string_view name = tokens.next();
    if (name.empty() || name.size() > Limits::nameBytes || printable(name, name.size()) != name) {
      return refuse("a layer's name must be one word of 1 to " + std::to_string(Limits::nameBytes) +
                    " printable characters, for example \"decision/target\"");
    }
    layer.name = name;
    for (std::string_view token = tokens.next(); !token.empty(); token = tokens.next()) {
      const auto frame = std::ranges::find(frameNames, token);
      if (frame != frameNames.end()) {
        layer.frame = static_cast<DrawingFrame>(frame - frameNames.begin());
        continue;
      }
      const auto life = number(token, Limits::maxLife);
      if (!life || *life <= 0.0) {
        return refuse(
            quotedToken(token) +
            " must be field, robot or belief, or the lifetime of the layer, up to 10 seconds");
      }
      layer.life = *life;
    }
    m_drawing.layers.push_back(std::move(layer));
    m_colour.reset();
    m_width = DrawingShape().width;
    return {};
  }

  Result<void> readColour(LineTokens& tokens) {
    const std::string_view token = tokens.next();
    const auto known = std::ranges::find(colourNames, token, &ColourName::token);
    if (token == "team") {
      m_colour.reset();
    } else if (known != colourNames.end()) {
      m_colour = known->value;
    } else if (const auto hex = hexColour(token)) {
      m_colour = hex;
    } else {
      return refuse(quotedToken(token) +
                    " is not a colour: use team, white, black, grey, red, orange, yellow, green, "
                    "cyan, blue, violet, magenta, pink, brown, #rrggbb or #rrggbbaa");
    }
    return {};
  }

  Result<void> readWidth(LineTokens& tokens) {
    const auto width = number(tokens.next(), Limits::widest);
    if (!width || *width < 0.5) return refuse("the width must be 0.5 to 20 pixels");
    m_width = *width;
    return {};
  }

  Result<void> readShape(const ShapeName& what, LineTokens& tokens) {
    DrawingLayer& layer = m_drawing.layers.back();
    const auto wrong = [&what] {
      return refuse(std::string(what.token) + " needs " + std::string(what.needs) +
                    " in metres, none beyond 1000");
    };
    DrawingShape shape;
    shape.kind = what.kind;
    shape.colour = m_colour;
    shape.width = m_width;
    const bool many = what.kind == ShapeKind::Line || what.kind == ShapeKind::Arrow ||
                      what.kind == ShapeKind::Polygon || what.kind == ShapeKind::Area;
    do {
      const std::string_view x = tokens.next(), y = tokens.next();
      if (x.empty() && shape.points.size() > 1) break;
      const auto px = number(x, Limits::farthest), py = number(y, Limits::farthest);
      if (!px || !py) return wrong();
      shape.points.push_back({*px, *py});
    } while (many && shape.points.size() <= Limits::points);
    const bool closed = what.kind == ShapeKind::Polygon || what.kind == ShapeKind::Area;
    if (closed && shape.points.size() < 3) return wrong();
    if (what.kind == ShapeKind::Circle || what.kind == ShapeKind::Disc) {
      const auto radius = number(tokens.next(), Limits::farthest);
      if (!radius || *radius < 0.0) return wrong();
      shape.radius = *radius;
    }
    if (what.kind == ShapeKind::Text) {
      const std::string_view text = tokens.rest();
      if (text.empty()) return wrong();
      if (text.size() > Limits::textBytes || printable(text, text.size()) != text) {
        return refuse("a text is printable UTF-8 of at most " + std::to_string(Limits::textBytes) +
                      " bytes");
      }
      shape.text = text;
    } else if (!many && !tokens.rest().empty()) {
      return wrong();
    }
    if (layer.shapes.size() == Limits::shapes ||
        m_points + shape.points.size() > Limits::robotPoints ||
        layer.points() + shape.points.size() > Limits::points) {
      return refuse("layer " + quotedToken(layer.name) + " has more than " +
                    std::to_string(Limits::shapes) + " shapes or " +
                    std::to_string(Limits::points) + " points; draw less, or on several layers");
    }
    m_points += shape.points.size();
    layer.shapes.push_back(std::move(shape));
    return {};
  }

  std::string_view m_rest;
  int m_line = 0;
  Drawing m_drawing;
  std::optional<std::uint32_t> m_colour;
  double m_width = DrawingShape().width;
  std::size_t m_points = 0;
};

void append(std::string& out, double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  out += ' ';
  out.append(text.data(), end);
}

std::string colourText(std::optional<std::uint32_t> colour) {
  if (!colour) return "team";
  constexpr std::string_view digits = "0123456789abcdef";
  const std::uint32_t value = *colour << 8U | *colour >> 24U;
  std::string text = "#";
  for (int shift = 28; shift >= 0; shift -= 4) text += digits[value >> unsigned(shift) & 0xfU];
  return text;
}

}  // namespace

std::size_t DrawingLayer::points() const {
  std::size_t sum = 0;
  for (const DrawingShape& shape : shapes) sum += shape.points.size();
  return sum;
}

Result<Drawing> parseDrawing(std::string_view text) {
  return DrawingReader(text).read();
}

std::string drawingText(const Drawing& drawing) {
  std::string out(magic);
  out += std::to_string(drawing.robot);
  if (drawing.team) out += ' ' + std::to_string(*drawing.team);
  for (const DrawingLayer& layer : drawing.layers) {
    out += layer.adds ? "\nmore " : "\nlayer ";
    out += layer.name;
    out += ' ';
    out += frameNames[static_cast<std::size_t>(layer.frame)];
    append(out, layer.life);
    DrawingShape before;
    for (const DrawingShape& shape : layer.shapes) {
      if (shape.colour != before.colour) out += "\ncolour " + colourText(shape.colour);
      if (shape.width != before.width) {
        out += "\nwidth";
        append(out, shape.width);
      }
      before.colour = shape.colour;
      before.width = shape.width;
      out += '\n';
      out += shapeNames[static_cast<std::size_t>(shape.kind)].token;
      for (const Point& point : shape.points) {
        append(out, point.x);
        append(out, point.y);
      }
      if (shape.kind == ShapeKind::Circle || shape.kind == ShapeKind::Disc) {
        append(out, shape.radius);
      }
      if (!shape.text.empty()) out += ' ' + shape.text;
    }
  }
  out += '\n';
  return out;
}

DatagramParts partsOf(std::string_view datagram) {
  if (datagram.starts_with(magic)) return {{}, datagram};
  constexpr std::string_view behind = "\nPBD1 ";
  const std::size_t at = datagram.find(behind);
  if (at == std::string_view::npos) return {datagram, {}};
  return {datagram.substr(0, at), datagram.substr(at + 1)};
}

}  // namespace pitchboard::telemetry
