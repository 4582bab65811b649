#include "viewer/render/webm.h"

#include <bit>
#include <cstddef>

namespace aerascope {
namespace {

// Names of elements as they stand in the file, length marker included.
enum Element : std::uint32_t {
  kEbml = 0x1A45DFA3,
  kEbmlVersion = 0x4286,
  kEbmlReadVersion = 0x42F7,
  kEbmlMaxIdLength = 0x42F2,
  kEbmlMaxSizeLength = 0x42F3,
  kDocType = 0x4282,
  kDocTypeVersion = 0x4287,
  kDocTypeReadVersion = 0x4285,
  kSegment = 0x18538067,
  kSeekHead = 0x114D9B74,
  kSeek = 0x4DBB,
  kSeekId = 0x53AB,
  kSeekPosition = 0x53AC,
  kInfo = 0x1549A966,
  kTimestampScale = 0x2AD7B1,
  kDuration = 0x4489,
  kMuxingApp = 0x4D80,
  kWritingApp = 0x5741,
  kTracks = 0x1654AE6B,
  kTrackEntry = 0xAE,
  kTrackNumber = 0xD7,
  kTrackUid = 0x73C5,
  kTrackType = 0x83,
  kFlagLacing = 0x9C,
  kDefaultDuration = 0x23E383,
  kCodecId = 0x86,
  kVideo = 0xE0,
  kPixelWidth = 0xB0,
  kPixelHeight = 0xBA,
  kColour = 0x55B0,
  kMatrixCoefficients = 0x55B1,
  kRange = 0x55B9,
  kTransferCharacteristics = 0x55BA,
  kPrimaries = 0x55BB,
  kCues = 0x1C53BB6B,
  kCuePoint = 0xBB,
  kCueTime = 0xB3,
  kCueTrackPositions = 0xB7,
  kCueTrack = 0xF7,
  kCueClusterPosition = 0xF1,
  kCluster = 0x1F43B675,
  kTimestamp = 0xE7,
  kSimpleBlock = 0xA3,
};

constexpr std::uint64_t kTrack = 1;
constexpr std::uint64_t kNanosecondsInMillisecond = 1'000'000;
constexpr std::int64_t kLongestCluster_ms = 30'000;  // a block's time counts from its cluster's, in 16 bits

std::string BigEndian(std::uint64_t value, std::size_t bytes) {
  std::string text(bytes, '\0');
  for (std::size_t i = bytes; i-- > 0; value >>= 8) text[i] = static_cast<char>(value & 0xffu);
  return text;
}

std::string Name(Element element) {
  std::size_t bytes = 1;
  while (bytes < 4 && (element >> (8 * bytes)) != 0) ++bytes;
  return BigEndian(element, bytes);
}

// The shortest form; a form of all ones means an unknown size and is not used.
std::string SizeField(std::uint64_t size) {
  std::size_t bytes = 1;
  while (bytes < 8 && size >= (std::uint64_t{1} << (7 * bytes)) - 1) ++bytes;
  return BigEndian(size | (std::uint64_t{1} << (7 * bytes)), bytes);
}

std::string Wrap(Element element, std::string_view content) {
  return Name(element) + SizeField(content.size()) + std::string(content);
}

// Eight bytes always where `fixed`, so that sizes do not depend on the number.
std::string Number(Element element, std::uint64_t value, bool fixed = false) {
  std::size_t bytes = fixed ? 8 : 1;
  while (bytes < 8 && (value >> (8 * bytes)) != 0) ++bytes;
  return Wrap(element, BigEndian(value, bytes));
}

std::string Real(Element element, double value) {
  return Wrap(element, BigEndian(std::bit_cast<std::uint64_t>(value), 8));
}

std::string Header() {
  return Wrap(kEbml, Number(kEbmlVersion, 1) + Number(kEbmlReadVersion, 1) + Number(kEbmlMaxIdLength, 4) +
                         Number(kEbmlMaxSizeLength, 8) + Wrap(kDocType, "webm") + Number(kDocTypeVersion, 4) +
                         Number(kDocTypeReadVersion, 2));
}

std::string Info(const WebmTrack& track, std::size_t pictures) {
  const double duration_ms = static_cast<double>(track.picture_ms) * static_cast<double>(pictures);
  return Wrap(kInfo, Number(kTimestampScale, kNanosecondsInMillisecond) + Real(kDuration, duration_ms) +
                         Wrap(kMuxingApp, "aerascope") + Wrap(kWritingApp, "aerascope"));
}

std::string Tracks(const WebmTrack& track) {
  constexpr std::uint64_t kVideoTrack = 1;
  constexpr std::uint64_t kBt709 = 1;
  constexpr std::uint64_t kBroadcastRange = 1;
  const std::string colour =
      Wrap(kColour, Number(kMatrixCoefficients, kBt709) + Number(kRange, kBroadcastRange) +
                        Number(kTransferCharacteristics, kBt709) + Number(kPrimaries, kBt709));
  const std::string video =
      Wrap(kVideo, Number(kPixelWidth, static_cast<std::uint64_t>(track.size.width)) +
                       Number(kPixelHeight, static_cast<std::uint64_t>(track.size.height)) + colour);
  const auto picture_ns = static_cast<std::uint64_t>(track.picture_ms) * kNanosecondsInMillisecond;
  return Wrap(kTracks, Wrap(kTrackEntry, Number(kTrackNumber, kTrack) + Number(kTrackUid, kTrack) +
                                             Number(kTrackType, kVideoTrack) + Number(kFlagLacing, 0) +
                                             Number(kDefaultDuration, picture_ns) +
                                             Wrap(kCodecId, track.codec) + video));
}

std::string Block(const PackedPicture& picture, std::int64_t ms_in_cluster) {
  constexpr char kKeyFlag = '\x80';
  return Wrap(kSimpleBlock, SizeField(kTrack) + BigEndian(static_cast<std::uint64_t>(ms_in_cluster), 2) +
                                std::string(1, picture.key ? kKeyFlag : '\0') + picture.bytes);
}

// Clusters begin with key pictures, and wherever the last one has grown too long.
struct Cluster {
  std::int64_t at_ms = 0;
  bool key = false;
  std::string blocks;

  std::string Written() const {
    return Wrap(kCluster, Number(kTimestamp, static_cast<std::uint64_t>(at_ms)) + blocks);
  }
};

std::vector<Cluster> Clusters(const WebmTrack& track, const std::vector<PackedPicture>& pictures) {
  std::vector<Cluster> clusters;
  std::int64_t at_ms = 0;
  for (const PackedPicture& picture : pictures) {
    if (clusters.empty() || picture.key || at_ms - clusters.back().at_ms > kLongestCluster_ms)
      clusters.push_back({at_ms, picture.key, ""});
    clusters.back().blocks += Block(picture, at_ms - clusters.back().at_ms);
    at_ms += track.picture_ms;
  }
  return clusters;
}

// Positions count from the first byte inside the Segment.
std::string Cues(const std::vector<Cluster>& clusters, const std::vector<std::uint64_t>& positions) {
  std::string points;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (!clusters[i].key) continue;
    points +=
        Wrap(kCuePoint, Number(kCueTime, static_cast<std::uint64_t>(clusters[i].at_ms), true) +
                            Wrap(kCueTrackPositions, Number(kCueTrack, kTrack) +
                                                         Number(kCueClusterPosition, positions[i], true)));
  }
  return Wrap(kCues, points);
}

std::string SeekEntry(Element element, std::uint64_t position) {
  return Wrap(kSeek, Wrap(kSeekId, Name(element)) + Number(kSeekPosition, position, true));
}

}  // namespace

std::string WebmFile(const WebmTrack& track, const std::vector<PackedPicture>& pictures) {
  const std::vector<Cluster> clusters = Clusters(track, pictures);
  std::vector<std::string> written;
  for (const Cluster& cluster : clusters) written.push_back(cluster.Written());
  const std::string info = Info(track, pictures.size());
  const std::string tracks = Tracks(track);
  const auto seek_head = [](std::uint64_t info_at, std::uint64_t tracks_at, std::uint64_t cues_at) {
    return Wrap(kSeekHead,
                SeekEntry(kInfo, info_at) + SeekEntry(kTracks, tracks_at) + SeekEntry(kCues, cues_at));
  };
  // Numbers of fixed width: what stands in front has its size before its content is known.
  std::vector<std::uint64_t> positions(clusters.size(), 0);
  const std::uint64_t info_at = seek_head(0, 0, 0).size();
  const std::uint64_t tracks_at = info_at + info.size();
  const std::uint64_t cues_at = tracks_at + tracks.size();
  std::uint64_t at = cues_at + Cues(clusters, positions).size();
  for (std::size_t i = 0; i < written.size(); ++i) {
    positions[i] = at;
    at += written[i].size();
  }
  std::string segment = seek_head(info_at, tracks_at, cues_at) + info + tracks + Cues(clusters, positions);
  for (const std::string& cluster : written) segment += cluster;
  return Header() + Wrap(kSegment, segment);
}

}  // namespace aerascope
