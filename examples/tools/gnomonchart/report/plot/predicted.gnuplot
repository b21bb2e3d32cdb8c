# What the model of auto predicts, and what was measured. Written by gnomonchart; "gnuplot ${NAME}.gnuplot" draws it again,
# as SVG and as PNG. Columns are set apart by tabs: predicted, measured, marker, colour, number.
$errors << EOD
${ERRORS}EOD
$times << EOD
${TIMES}EOD
set datafile separator "\t"
set encoding utf8
width = ${WIDTH}
height = ${HEIGHT}
# x and y of the page in px, from its lower left corner.
X(px) = px / real(width)
Y(px) = px / real(height)

do for [format in "svg png"] {
  if (format eq "svg") {
    set terminal svg size width,height font "DejaVu Sans,11" linewidth 1 background rgb "white" rounded noenhanced
  } else {
    set terminal pngcairo size 2*width,2*height font "DejaVu Sans,11" fontscale 1.5 linewidth 2 pointscale 2 rounded noenhanced
  }
  set output "${NAME}." . format
  set multiplot
  set border 3 lc rgb "#9ca3af" lw 0.8
  set tics nomirror out scale 0.5 textcolor rgb "#374151"
  set grid xtics ytics lt 1 lc rgb "#eceef1" lw 0.8
  set logscale xy
  set nokey
${PANELS}
  unset multiplot
  set output
}
