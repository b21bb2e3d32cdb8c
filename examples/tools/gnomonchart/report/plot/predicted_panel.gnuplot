  unset label
  unset arrow
  set lmargin at screen X(${LEFT})
  set rmargin at screen X(${RIGHT})
  set bmargin at screen Y(${BOTTOM})
  set tmargin at screen Y(${TOP})
  set xrange [${LOW}:${HIGH}]
  set yrange [${LOW}:${HIGH}]
  set xtics (${TICS})
  set ytics (${TICS})
  set xlabel 'predicted (${UNIT})' offset 0,0.4 textcolor rgb "#374151"
  set ylabel 'measured (${UNIT})' offset 0.6,0 textcolor rgb "#374151"
${LABELS}
  plot x with lines lw 1.2 lc rgb "#111827", \
    ${FACTOR}*x with lines dt (10,9) lw 0.8 lc rgb "#9ca3af", \
    x/${FACTOR} with lines dt (10,9) lw 0.8 lc rgb "#9ca3af", \
    $${PANEL} using 1:2:3:4 with points pt variable ps 0.8 lc rgb variable, \
    $${PANEL} using 1:2:5 with labels hypertext point pt 7 ps 0.8 lc rgb "#ff000000"
