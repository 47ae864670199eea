#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace osteon {

/// A film as FFmpeg's libraries read it.
struct ReadFilm {
  std::string format, picture_codec, sound_codec;
  int width = 0, height = 0, sound_hz = 0;
  double duration_s = 0;                            ///< as the file says
  std::vector<std::vector<std::uint8_t>> pictures;  ///< luma, without padding
  std::vector<double> times_s;
  std::vector<float> sound;
};

namespace film_reading {

inline void take(const AVFrame& frame, ReadFilm& film) {
  if (frame.width > 0) {
    std::vector<std::uint8_t> luma;
    for (int row = 0; row < frame.height; ++row) {
      const std::uint8_t* from = frame.data[0] + row * frame.linesize[0];
      luma.insert(luma.end(), from, from + frame.width);
    }
    film.pictures.push_back(std::move(luma));
    return;
  }

  const auto* samples = reinterpret_cast<const float*>(frame.data[0]);
  film.sound.insert(film.sound.end(), samples, samples + frame.nb_samples);
}

inline void drain(AVCodecContext* decoder, const AVPacket* packet, ReadFilm& film) {
  AVFrame* frame = av_frame_alloc();
  if (avcodec_send_packet(decoder, packet) >= 0)
    while (avcodec_receive_frame(decoder, frame) >= 0) take(*frame, film);
  av_frame_free(&frame);
}

inline AVCodecContext* decoder_of(const AVStream& stream) {
  AVCodecContext* decoder = avcodec_alloc_context3(avcodec_find_decoder(stream.codecpar->codec_id));
  avcodec_parameters_to_context(decoder, stream.codecpar);
  decoder->thread_count = 1;
  if (avcodec_open2(decoder, nullptr, nullptr) < 0) ADD_FAILURE() << "no decoder";
  return decoder;
}

}  // namespace film_reading

/// Reads all that can be read; a file that breaks off gives what is before the break.
inline ReadFilm read_film(const std::string& file) {
  ReadFilm film;
  av_log_set_level(AV_LOG_QUIET);
  AVFormatContext* in = nullptr;
  if (avformat_open_input(&in, file.c_str(), nullptr, nullptr) < 0) return film;
  film.format = in->iformat->name;
  avformat_find_stream_info(in, nullptr);
  if (in->duration != AV_NOPTS_VALUE)
    film.duration_s = static_cast<double>(in->duration) / AV_TIME_BASE;
  std::vector<AVCodecContext*> decoders;
  for (unsigned s = 0; s < in->nb_streams; ++s) {
    const AVCodecParameters& codec = *in->streams[s]->codecpar;
    const std::string name = avcodec_get_name(codec.codec_id);
    if (codec.codec_type == AVMEDIA_TYPE_VIDEO) {
      film.picture_codec = name;
      film.width = codec.width;
      film.height = codec.height;
    } else {
      film.sound_codec = name;
      film.sound_hz = codec.sample_rate;
    }
    decoders.push_back(film_reading::decoder_of(*in->streams[s]));
  }
  AVPacket* packet = av_packet_alloc();
  while (av_read_frame(in, packet) >= 0) {
    const auto s = static_cast<std::size_t>(packet->stream_index);
    if (in->streams[s]->codecpar->codec_type == AVMEDIA_TYPE_VIDEO)
      film.times_s.push_back(static_cast<double>(packet->pts) * av_q2d(in->streams[s]->time_base));
    film_reading::drain(decoders[s], packet, film);
    av_packet_unref(packet);
  }
  for (AVCodecContext*& decoder : decoders) {
    film_reading::drain(decoder, nullptr, film);
    avcodec_free_context(&decoder);
  }
  av_packet_free(&packet);
  avformat_close_input(&in);
  return film;
}

/// Level of one frequency in a sound: the size of its Fourier sum, as that of a sine of level 1 is
/// 1.
inline double level_at(const std::vector<float>& sound, double hz, double sound_hz) {
  double re = 0, im = 0;
  for (std::size_t k = 0; k < sound.size(); ++k) {
    const double turn = 2 * 3.14159265358979323846 * hz * static_cast<double>(k) / sound_hz;
    re += static_cast<double>(sound[k]) * std::cos(turn);
    im += static_cast<double>(sound[k]) * std::sin(turn);
  }
  return sound.empty() ? 0 : 2 * std::hypot(re, im) / static_cast<double>(sound.size());
}

}  // namespace osteon
