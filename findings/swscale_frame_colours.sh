#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# libswscale 5.1 (Debian 12, FFmpeg 5.1): sws_scale_frame() takes whole frames, and yet neither `colorspace` nor
# `color_range` of the source frame changes the RGB values: they are always those of BT.601 with limited range. A film in HD
# comes out with wrong greens, and a full-range one with too much contrast, until sws_setColorspaceDetails() is called with
# what the frame says.
# Output seen (Y 120, U 90, V 170 everywhere):
#   the frame says nothing:          188 102 44
#   the frame says BT.709:           188 102 44
#   the frame says full range:       188 102 44
#   BT.709 told to the scaler:       196 107 41
#   full range told to the scaler:   179 103 53
# Exits with 2 if it could not be tried; fails if the behaviour is another one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
unable() { echo "could not be tried: $1" >&2; exit 2; }
command -v g++ >/dev/null || unable "no g++"
version=$(apt-cache madison libswscale-dev 2>/dev/null | awk '$3 ~ /^7:5\.1\./ { print $3; exit }')
[ -n "$version" ] || unable "apt-get finds no libswscale-dev 5.1 (Debian 12)"
apt-get download "libswscale-dev=$version" "libswscale6=$version" "libavutil-dev=$version" "libavutil57=$version" \
  >/dev/null 2>&1 || unable "apt-get download failed"
for package in ./*.deb; do dpkg -x "$package" root; done
headers=$(dirname "$(dirname "$(find root -name swscale.h | head -n 1)")")
libraries=$(dirname "$(find root -name 'libswscale.so.6*' | head -n 1)")

cat >colours.cpp <<'CODE'
extern "C" {
#include <libavutil/frame.h>
#include <libswscale/swscale.h>
}
#include <cstdio>
#include <cstring>

enum class Told { Nothing, Matrix, Range };

void convert(const char* what, AVColorSpace space, AVColorRange range, Told told) {
  AVFrame* yuv = av_frame_alloc();
  yuv->format = AV_PIX_FMT_YUV444P;
  yuv->width = yuv->height = 64;
  yuv->colorspace = space;
  yuv->color_range = range;
  av_frame_get_buffer(yuv, 0);
  const int values[3] = {120, 90, 170};
  for (int plane = 0; plane < 3; ++plane) std::memset(yuv->data[plane], values[plane], 64 * yuv->linesize[plane]);
  AVFrame* rgb = av_frame_alloc();
  rgb->format = AV_PIX_FMT_RGB24;
  rgb->width = rgb->height = 64;
  SwsContext* scaler = sws_getContext(64, 64, AV_PIX_FMT_YUV444P, 64, 64, AV_PIX_FMT_RGB24, SWS_ACCURATE_RND | SWS_BICUBIC,
                                      nullptr, nullptr, nullptr);
  if (told != Told::Nothing) {
    const int* matrix = sws_getCoefficients(told == Told::Matrix ? SWS_CS_ITU709 : SWS_CS_ITU601);
    sws_setColorspaceDetails(scaler, matrix, told == Told::Range, matrix, 1, 0, 1 << 16, 1 << 16);
  }
  sws_scale_frame(scaler, rgb, yuv);
  const unsigned char* pixel = rgb->data[0] + 32 * rgb->linesize[0] + 96;
  std::printf("%-32s %d %d %d\n", what, pixel[0], pixel[1], pixel[2]);
  sws_freeContext(scaler);
  av_frame_free(&yuv);
  av_frame_free(&rgb);
}

int main() {
  convert("the frame says nothing:", AVCOL_SPC_UNSPECIFIED, AVCOL_RANGE_UNSPECIFIED, Told::Nothing);
  convert("the frame says BT.709:", AVCOL_SPC_BT709, AVCOL_RANGE_UNSPECIFIED, Told::Nothing);
  convert("the frame says full range:", AVCOL_SPC_UNSPECIFIED, AVCOL_RANGE_JPEG, Told::Nothing);
  convert("BT.709 told to the scaler:", AVCOL_SPC_BT709, AVCOL_RANGE_UNSPECIFIED, Told::Matrix);
  convert("full range told to the scaler:", AVCOL_SPC_UNSPECIFIED, AVCOL_RANGE_JPEG, Told::Range);
}
CODE
g++ -I"$headers" colours.cpp -o colours "$libraries"/libswscale.so.6 "$libraries"/libavutil.so.57 \
  -Wl,--allow-shlib-undefined || unable "the program does not build"
seen=$(LD_LIBRARY_PATH=$libraries ./colours) || unable "libavutil57 needs packages that are not installed"
echo "$seen"
[ "$seen" = "the frame says nothing:          188 102 44
the frame says BT.709:           188 102 44
the frame says full range:       188 102 44
BT.709 told to the scaler:       196 107 41
full range told to the scaler:   179 103 53" ] || { echo "The behaviour has changed." >&2; exit 1; }
