#pragma once

#include "experiments/figures/channel_pictures.h"
#include "experiments/figures/derivative_map.h"
#include "experiments/io/receiver_grid.h"

#include <string>
#include <vector>

namespace irradiff {

/// A picture on a page.
struct PagePicture {
  MapPicture picture;
  std::vector<std::string> values;  ///< the channels to read while it is compared; all where no picture names any
  std::string note;                 ///< a sentence behind its caption, with a space before it
};

/// What a figure's page shows. Texts are HTML where it says so.
struct FigurePageContent {
  std::string title;         ///< plain
  std::string introduction;  ///< HTML
  ReceiverGrid grid;
  std::vector<MapChannel> values;  ///< what can be read at a receiver
  std::vector<PagePicture> pictures;
  std::string left;  ///< names of the pictures that are compared first
  std::string right;
  std::string results;   ///< HTML before the pictures
  std::string appendix;  ///< HTML behind them
  std::string files;     ///< HTML, a paragraph
};

/// A figure element with the picture in it, its colour bars and its caption.
std::string pictureHtml(const PagePicture& shown);

/// One HTML document without anything from the network: two pictures under a slider, the values at the receiver under
/// the pointer (single precision, of at most kPageValues x kPageValues receivers), then all pictures with their colour
/// bars, which are there without scripts and in print too.
std::string figurePage(const FigurePageContent& content);

/// As many as the standard figures have, which makes 22 MB of a page with all estimators; a browser has it in a second.
inline constexpr std::size_t kPageValues = 256;

/// "W/m^2" with a raised digit, in UTF-8.
std::string unitText(const std::string& unit);

}  // namespace irradiff
