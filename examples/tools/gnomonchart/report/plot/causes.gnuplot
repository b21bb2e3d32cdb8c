# Why pixels are wrong. Written by gnomonchart; "gnuplot ${NAME}.gnuplot" draws it again, as SVG and as PNG. Columns are
# set apart by tabs. Bars: middle in % of the wrong pixels, row, ends, lower and upper side, colour. Shares: % of the
# pixels that are judged, row, colour.
$bars << EOD
${BARS}EOD
$shares << EOD
${SHARES}EOD
set datafile separator "\t"
set encoding utf8
width = ${WIDTH}
height = ${HEIGHT}
# x and y of the page in px, from its lower left corner.
X(px) = px / real(width)
Y(px) = px / real(height)

do for [format in "svg png"] {
  if (format eq "svg") {
    set terminal svg size width,height font "DejaVu Sans,11" linewidth 1 background rgb "white" noenhanced
  } else {
    set terminal pngcairo size 2*width,2*height font "DejaVu Sans,11" fontscale 1.5 linewidth 2 pointscale 2 noenhanced
  }
  set output "${NAME}." . format
  set multiplot
  unset label
  unset arrow
  unset logscale
  set nokey
  set tics nomirror out scale 0.5 textcolor rgb "#374151"
  set grid xtics lt 1 lc rgb "#eceef1" lw 0.8
  set border 1 lc rgb "#9ca3af" lw 0.8
  set style fill solid 1 noborder
  unset ytics
  set yrange [${ROWS}:0]
  set tmargin at screen Y(${TOP})
  set bmargin at screen Y(${BOTTOM})
${LABELS}
  set lmargin at screen X(${BARLEFT})
  set rmargin at screen X(${BARRIGHT})
  set xrange [0:100]
  set xtics 25
  set xlabel 'of the wrong pixels (%)' offset 0,0.4 textcolor rgb "#374151"
  plot $bars using 1:2:3:4:5:6:7 with boxxyerror lc rgb variable
  unset label
  set lmargin at screen X(${DOTLEFT})
  set rmargin at screen X(${DOTRIGHT})
  set logscale x
  set xrange [${LOW}:${HIGH}]
  set xtics (${XTICS})
  set xlabel 'wrong, of the pixels judged (%)' offset 0,0.4 textcolor rgb "#374151"
  plot $shares using 1:2:3 with points pt 7 ps 0.8 lc rgb variable
  unset multiplot
  set output
}
