#include "hlc_bridge/render/video.hpp"

#include <fcntl.h>

#include <utility>
#include <vector>

namespace hlc::render {
namespace {

/// Every picture of a GIF has its own colours: common ones are known only after the last picture,
/// and until then all of them would be kept in memory.
constexpr const char* kGifColours =
    "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=none";

std::vector<std::string> command_for(const std::filesystem::path& file, int frames_per_s) {
  std::vector<std::string> command{needed_path_of("ffmpeg", "ffmpeg"),
                                   "-loglevel",
                                   "error",
                                   "-nostdin",
                                   "-f",
                                   "image2pipe",
                                   "-framerate",
                                   std::to_string(frames_per_s),
                                   "-c:v",
                                   "png",
                                   "-i",
                                   "pipe:0"};
  const std::vector<std::string> mp4{
      "-c:v", "libx264", "-crf", "18", "-movflags", "+faststart",
      // What players assume for a video of this size.
      "-vf", "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p", "-colorspace", "bt709",
      "-color_primaries", "bt709", "-color_trc", "bt709"};
  const std::vector<std::string> gif{"-filter_complex", kGifColours};
  const std::vector<std::string>& coding = file.extension() == ".gif" ? gif : mp4;
  command.insert(command.end(), coding.begin(), coding.end());
  command.push_back("file:" + file.string());
  return command;
}

std::vector<int> files_of(const Pipe& frames, const Descriptor& log) {
  return {frames.out.number(), log.number(), log.number()};
}

}  // namespace

Video::Video(const std::filesystem::path& file, int frames_per_s, std::filesystem::path log)
    : log_(std::move(log)),
      process_(command_for(file, frames_per_s),
               files_of(frames_, open_file(log_, O_WRONLY | O_CREAT))) {
  frames_.out.close();
}

void Video::add(std::string_view png) {
  try {
    write_all(frames_.in, png);
  } catch (const Fault&) {
    fail();
  }
}

void Video::finish() {
  frames_.in.close();
  if (!process_.is_good_at_end()) fail();
}

void Video::fail() const { throw Fault("ffmpeg has failed: " + last_line_of(log_)); }

}  // namespace hlc::render
