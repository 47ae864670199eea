#include "osteon/media/film_writer.h"

#include <algorithm>
#include <cerrno>
#include <string>
#include <utility>
#include <vector>

#include "libav.h"
#include "out_file.h"
#include "yuv.h"

namespace osteon {
namespace {

constexpr int kIoBytes = 1 << 16;
constexpr int kKeyEvery_s = 2;       // pictures that one can jump to
constexpr int kOpusBits = 64000;     // a second
constexpr double kPixelBits = 0.12;  // a pixel and picture: what the encoder aims at

}  // namespace

/// An encoder with its stream and what it needs for one frame.
struct FilmTrack {
  AVCodecContext* codec = nullptr;
  AVStream* stream = nullptr;
  AVFrame* frame = nullptr;
  std::int64_t next = 0;  ///< in the codec's time base
};

/// Where FFmpeg writes.
struct FilmIo {
  OutFile file;
  int error_number = 0;  ///< of the first write that failed
};

struct FilmWriter::Impl {
  Libav av;
  FilmFormat format;
  FilmIo out;
  AVFormatContext* muxer = nullptr;
  AVIOContext* io = nullptr;
  FilmTrack picture, sound;
  AVPacket* packet = nullptr;
  std::vector<float> samples;  ///< not yet enough for a frame
  bool begun = false, ended = false;

  Impl(const Libav& libraries, const FilmFormat& wanted, OutFile file)
      : av(libraries), format(wanted), out{std::move(file)} {}
  ~Impl();
  Impl(const Impl&) = delete;

  Result<void> open();
  Result<AVCodecContext*> encoder(const char* name) const;
  Result<void> open_picture();
  Result<void> open_sound();
  Result<void> start(FilmTrack& track, AVDictionary** options);
  Result<void> begin();
  Result<void> encode(FilmTrack& track, AVFrame* frame);
  Result<void> encode_sound(int count);
  Error failed(const char* what, int code) const;
  /// The film ends here; what was written is kept where the disk is full.
  tl::unexpected<Error> give_up(Error error);
};

namespace {

// What FFmpeg hands over or asks for goes to the file; its first error is remembered.
int write_some(void* opaque, std::uint8_t* bytes, int count) {
  auto& io = *static_cast<FilmIo*>(opaque);
  const int bad = io.file.write(bytes, static_cast<std::size_t>(count));
  if (bad == 0) return count;
  if (io.error_number == 0) io.error_number = bad;
  return AVERROR(bad);
}

std::int64_t seek_to(void* opaque, std::int64_t offset, int whence) {
  auto& io = *static_cast<FilmIo*>(opaque);
  if ((whence & AVSEEK_SIZE) != 0) return io.file.size();
  if ((whence & ~AVSEEK_FORCE) != SEEK_SET || !io.file.seek(offset)) return AVERROR(ESPIPE);
  return offset;
}

}  // namespace

FilmWriter::Impl::~Impl() {
  for (FilmTrack* track : {&picture, &sound}) {
    if (track->frame) av.av_frame_free(&track->frame);
    if (track->codec) av.avcodec_free_context(&track->codec);
  }
  if (packet) av.av_packet_free(&packet);
  if (muxer) av.avformat_free_context(muxer);
  if (io) {
    av.av_freep(&io->buffer);
    av.avio_context_free(&io);
  }
}

Error FilmWriter::Impl::failed(const char* what, int code) const {
  if (out.error_number != 0) return write_error(out.error_number, out.file.file());
  return {std::string(what) + " (" + libav_text(av, code) + ")", out.file.file().string(), ""};
}

tl::unexpected<Error> FilmWriter::Impl::give_up(Error error) {
  const bool first = !ended;
  ended = true;
  if (!first || out.error_number == 0 || !begun || picture.next == 0) return tl::unexpected(error);
  // All that the file took can be played but for the piece at its end that is not whole.
  if (out.file.size() > 0 && out.file.keep())
    error.todo += "; the part written so far is kept and can be played";
  return tl::unexpected(error);
}

Result<AVCodecContext*> FilmWriter::Impl::encoder(const char* name) const {
  const AVCodec* codec = av.avcodec_find_encoder_by_name(name);
  if (codec == nullptr)
    return fail("the installed FFmpeg has no encoder '" + std::string(name) + "'", "films",
                "Install one that has it, such as Debian's libavcodec" +
                    std::to_string(LIBAVCODEC_VERSION_MAJOR));
  AVCodecContext* context = av.avcodec_alloc_context3(codec);
  if (context == nullptr) return fail("there is not enough memory", "films");
  if ((muxer->oformat->flags & AVFMT_GLOBALHEADER) != 0)
    context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  context->flags |= AV_CODEC_FLAG_BITEXACT;
  return context;
}

Result<void> FilmWriter::Impl::start(FilmTrack& track, AVDictionary** options) {
  const int opened = av.avcodec_open2(track.codec, track.codec->codec, options);
  av.av_dict_free(options);
  if (opened < 0) return tl::unexpected(failed("the encoder does not start", opened));
  track.stream = av.avformat_new_stream(muxer, nullptr);
  track.frame = av.av_frame_alloc();
  if (!track.stream || !track.frame) return fail("there is not enough memory", "films");
  track.stream->time_base = track.codec->time_base;
  av.avcodec_parameters_from_context(track.stream->codecpar, track.codec);
  return {};
}

Result<void> FilmWriter::Impl::open_picture() {
  auto made = encoder("libvpx-vp9");
  if (!made) return tl::unexpected(made.error());
  AVCodecContext& codec = *(picture.codec = *made);
  codec.width = format.width;
  codec.height = format.height;
  codec.time_base = {1, format.fps};
  codec.framerate = {format.fps, 1};
  codec.pix_fmt = AV_PIX_FMT_YUV420P;
  codec.color_range = AVCOL_RANGE_MPEG;
  codec.colorspace = AVCOL_SPC_BT709;
  codec.color_primaries = AVCOL_PRI_BT709;
  codec.color_trc = AVCOL_TRC_BT709;
  codec.gop_size = kKeyEvery_s * format.fps;
  codec.thread_count = 2;
  const double bits = kPixelBits * format.width * format.height * format.fps;
  codec.bit_rate = static_cast<std::int64_t>(std::max(bits, 2e5));
  AVDictionary* options = nullptr;
  // The fastest that the encoder has, each picture as soon as it comes.
  for (const auto& [key, value] : {std::pair{"deadline", "realtime"},
                                   {"cpu-used", "8"},
                                   {"lag-in-frames", "0"},
                                   {"auto-alt-ref", "0"},
                                   {"tile-columns", "1"}})
    av.av_dict_set(&options, key, value, 0);
  if (auto ok = start(picture, &options); !ok) return ok;
  picture.stream->avg_frame_rate = codec.framerate;
  picture.frame->format = codec.pix_fmt;
  picture.frame->width = codec.width;
  picture.frame->height = codec.height;
  const int got = av.av_frame_get_buffer(picture.frame, 0);
  return got < 0 ? Result<void>(tl::unexpected(failed("there is not enough memory", got)))
                 : Result<void>();
}

Result<void> FilmWriter::Impl::open_sound() {
  if (!format.sound) return {};
  auto made = encoder("libopus");
  if (!made) return tl::unexpected(made.error());
  AVCodecContext& codec = *(sound.codec = *made);
  codec.sample_rate = kSoundHz;
  codec.sample_fmt = AV_SAMPLE_FMT_FLT;
  codec.time_base = {1, kSoundHz};
  codec.bit_rate = kOpusBits;
  av.av_channel_layout_default(&codec.ch_layout, 1);
  AVDictionary* options = nullptr;
  if (auto ok = start(sound, &options); !ok) return ok;
  AVFrame& frame = *sound.frame;
  frame.format = codec.sample_fmt;
  frame.nb_samples = codec.frame_size;
  frame.sample_rate = kSoundHz;
  av.av_channel_layout_default(&frame.ch_layout, 1);
  const int got = av.av_frame_get_buffer(sound.frame, 0);
  return got < 0 ? Result<void>(tl::unexpected(failed("there is not enough memory", got)))
                 : Result<void>();
}

Result<void> FilmWriter::Impl::open() {
  const int made = av.avformat_alloc_output_context2(&muxer, nullptr, "webm", nullptr);
  if (made < 0) return tl::unexpected(failed("the installed FFmpeg cannot write WebM", made));
  muxer->flags |= AVFMT_FLAG_BITEXACT;
  // Opus begins a little before its first sample, which WebM has a field for.
  muxer->avoid_negative_ts = AVFMT_AVOID_NEG_TS_DISABLED;
  if (auto ok = open_picture(); !ok) return ok;
  if (auto ok = open_sound(); !ok) return ok;
  auto* buffer = static_cast<std::uint8_t*>(av.av_malloc(kIoBytes));
  packet = av.av_packet_alloc();
  if (!buffer || !packet) return fail("there is not enough memory", "films");
  io = av.avio_alloc_context(buffer, kIoBytes, 1, &out, nullptr, write_some,
                             out.file.seekable() ? seek_to : nullptr);
  if (!io) return fail("there is not enough memory", "films");
  muxer->pb = io;
  return begin();
}

Result<void> FilmWriter::Impl::begin() {
  AVDictionary* options = nullptr;
  // Short pieces: a disk that is full costs the last of them.
  av.av_dict_set(&options, "cluster_time_limit", "500", 0);
  const int written = av.avformat_write_header(muxer, &options);
  av.av_dict_free(&options);
  if (written < 0 || out.error_number != 0)
    return tl::unexpected(failed("the film cannot be started", written));
  begun = true;
  return {};
}

Result<void> FilmWriter::Impl::encode(FilmTrack& track, AVFrame* frame) {
  int code = av.avcodec_send_frame(track.codec, frame);
  while (code >= 0) {
    code = av.avcodec_receive_packet(track.codec, packet);
    if (code < 0) break;
    av.av_packet_rescale_ts(packet, track.codec->time_base, track.stream->time_base);
    packet->stream_index = track.stream->index;
    code = av.av_interleaved_write_frame(muxer, packet);
  }
  const bool good = code == AVERROR(EAGAIN) || code == AVERROR_EOF || code >= 0;
  if (good && out.error_number == 0) return {};
  return give_up(failed("a picture or sound cannot be encoded", code));
}

Result<void> FilmWriter::Impl::encode_sound(int count) {
  AVFrame& frame = *sound.frame;
  av.av_frame_make_writable(&frame);
  auto* to = reinterpret_cast<float*>(frame.data[0]);
  std::copy_n(samples.begin(), count, to);
  samples.erase(samples.begin(), samples.begin() + count);
  frame.nb_samples = count;
  frame.pts = sound.next;
  sound.next += count;
  return encode(sound, &frame);
}

FilmWriter::FilmWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FilmWriter::~FilmWriter() = default;
FilmWriter::FilmWriter(FilmWriter&&) noexcept = default;
FilmWriter& FilmWriter::operator=(FilmWriter&&) noexcept = default;

Result<FilmWriter> FilmWriter::create(const std::filesystem::path& file, const FilmFormat& format) {
  const auto side_is_bad = [](int side) { return side < kLeastFilmSide || side > kMostFilmSide; };
  if (side_is_bad(format.width) || side_is_bad(format.height))
    return fail("a film's sides must be " + std::to_string(kLeastFilmSide) + " to " +
                    std::to_string(kMostFilmSide) + " pixels",
                file.string());
  if (format.fps < 1 || format.fps > 120)
    return fail("a film has 1 to 120 pictures a second", file.string());
  const auto files = libav_files();
  const auto av = load_libav(files);
  if (!av) return tl::unexpected(av.error());
  auto out = OutFile::create(file);
  if (!out) return tl::unexpected(out.error());
  auto impl = std::make_unique<Impl>(*av, format, std::move(*out));
  if (auto ok = impl->open(); !ok) return tl::unexpected(ok.error());
  return FilmWriter(std::move(impl));
}

Result<void> FilmWriter::add_picture(std::span<const std::uint8_t> rgb) {
  Impl& impl = *impl_;
  const FilmFormat& f = impl.format;
  if (impl.ended) return fail("the film has ended", impl.out.file.file().string());
  if (rgb.size() != 3u * static_cast<std::size_t>(f.width) * static_cast<std::size_t>(f.height))
    return fail("a picture does not have the film's size", impl.out.file.file().string());
  AVFrame& frame = *impl.picture.frame;
  impl.av.av_frame_make_writable(&frame);
  to_yuv420(rgb, f.width, f.height, {frame.data[0], frame.linesize[0]},
            {frame.data[1], frame.linesize[1]}, {frame.data[2], frame.linesize[2]});
  frame.pts = impl.picture.next++;
  return impl.encode(impl.picture, &frame);
}

Result<void> FilmWriter::add_sound(std::span<const float> samples) {
  Impl& impl = *impl_;
  if (impl.ended) return fail("the film has ended", impl.out.file.file().string());
  if (!impl.format.sound) return {};
  impl.samples.insert(impl.samples.end(), samples.begin(), samples.end());
  const int frame = impl.sound.codec->frame_size;
  while (impl.samples.size() >= static_cast<std::size_t>(frame))
    if (auto ok = impl.encode_sound(frame); !ok) return ok;
  return {};
}

Result<void> FilmWriter::finish() {
  Impl& impl = *impl_;
  if (impl.ended) return fail("the film has ended", impl.out.file.file().string());
  if (impl.format.sound) {
    if (!impl.samples.empty())
      if (auto ok = impl.encode_sound(static_cast<int>(impl.samples.size())); !ok) return ok;
    if (auto ok = impl.encode(impl.sound, nullptr); !ok) return ok;
  }
  if (auto ok = impl.encode(impl.picture, nullptr); !ok) return ok;
  const int code = impl.av.av_write_trailer(impl.muxer);
  if (code < 0 || impl.out.error_number != 0)
    return impl.give_up(impl.failed("the film cannot be ended", code));
  impl.ended = true;
  return impl.out.file.keep();
}

}  // namespace osteon
