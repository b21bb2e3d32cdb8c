# How far each technique gets. Written by gnomonchart --stability; "gnuplot ${NAME}.gnuplot" draws it again, as SVG and as
# PNG. Columns are set apart by tabs: column and row of a cell, colour.
$cells << EOD
${CELLS}EOD
$stated << EOD
${STATED}EOD
$elsewhere << EOD
${ELSEWHERE}EOD
$crosses << EOD
${CROSSES}EOD
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
  unset label
  unset arrow
  set nokey
  unset border
  unset xtics
  unset ytics
  set xrange [0:${COLUMNS}]
  set yrange [${ROWS}:0]
  set lmargin at screen X(${LEFT})
  set rmargin at screen X(${RIGHT})
  set tmargin at screen Y(${TOP})
  set bmargin at screen Y(${BOTTOM})
${LABELS}
  plot $cells using 1:2:(0.46):(0.44):3 with boxxyerror lc rgb variable fs solid 1 noborder, \
       $stated using 1:2:(0.46):(0.44) with boxxyerror lc rgb "#111827" lw 0.6 fs transparent pattern 4 noborder, \
       $elsewhere using 1:2 with points pt 7 ps 0.35 lc rgb "#111827", \
       $crosses using 1:2 with points pt 2 ps 0.75 lw 1.4 lc rgb "#111827"
  set output
}
