#include "loops/device_log.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "osteon/base/file.h"
#include "osteon/base/log.h"

namespace osteon {

DeviceLog::DeviceLog(std::unique_ptr<HapticDevice> device, double seconds,
                     std::filesystem::path file)
    : device_(std::move(device)),
      file_(std::move(file)),
      rows_(std::max<std::size_t>(
          1, static_cast<std::size_t>(seconds * std::max(1.0, device_->info().rate_hz)))) {
  if (!file_.empty()) (void)save(file_);
}

DeviceSample DeviceLog::read() {
  const DeviceSample sample = device_->read();
  now_.time_ns = sample.time_ns;
  now_.p_V = sample.X_VD.p;
  return sample;
}

void DeviceLog::write_torque(const Vec3& torque_V) {
  now_.wrench.torque_V = torque_V;
  device_->write_torque(torque_V);
}

void DeviceLog::write_force(const Vec3& force_V) {
  now_.wrench.force_V = force_V;
  rows_[count_++ % rows_.size()] = now_;
  now_.wrench.torque_V.setZero();
  device_->write_force(force_V);
}

void DeviceLog::close() {
  device_->close();
  if (closed_) return;
  closed_ = true;
  if (file_.empty()) return;
  if (const auto saved = save(file_); !saved) log(LogLevel::kWarning, saved.error().message());
}

std::string DeviceLog::line_of(const Row& row, bool with_torque) {
  const Vec3& f = row.wrench.force_V;
  const Vec3& t = row.wrench.torque_V;
  char line[200];
  std::snprintf(line, sizeof line, "%.6f,%.4f,%.4f,%.4f,%.5f,%.5f,%.5f",
                static_cast<double>(row.time_ns) * 1e-9, row.p_V.x() * 1e3, row.p_V.y() * 1e3,
                row.p_V.z() * 1e3, f.x(), f.y(), f.z());
  std::string text = line;
  if (with_torque) {
    std::snprintf(line, sizeof line, ",%.6f,%.6f,%.6f", t.x(), t.y(), t.z());
    text += line;
  }
  return text + "\n";
}

Result<void> DeviceLog::save(const std::filesystem::path& file) const {
  const bool with_torque = info().drives_rotation();
  std::string text = "time_s,x_mm,y_mm,z_mm,fx_n,fy_n,fz_n";
  text += with_torque ? ",tx_nm,ty_nm,tz_nm\n" : "\n";
  const std::size_t kept = std::min(count_, rows_.size());
  for (std::size_t i = count_ - kept; i < count_; ++i)
    text += line_of(rows_[i % rows_.size()], with_torque);
  if (closed_) text += "closed\n";
  return write_file_atomic(file, text);
}

}  // namespace osteon
