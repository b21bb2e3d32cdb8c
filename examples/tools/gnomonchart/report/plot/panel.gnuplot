  unset label
  unset arrow
  set lmargin at screen X(${LEFT})
  set rmargin at screen X(${RIGHT})
  set bmargin at screen Y(${BOTTOM})
  set tmargin at screen Y(${TOP})
  set xrange [${XLOW}:${XHIGH}]
  set yrange [${YLOW}:${YHIGH}]
  set xtics (${XTICS})
  set ytics (${YTICS})
  set xlabel '${XLABEL}' offset 0,0.4 textcolor rgb "#374151"
  set ylabel 'boundary error, 95th percentile (px)' offset 0.6,0 textcolor rgb "#374151"
${LABELS}
  plot $${PANEL}_floor using 1:2 with lines dt (10,9) lw 1.2 lc rgb "#111827", \
    $${PANEL}_staircase using 1:2 with lines lw 7 lc rgb "#fbe3b0", \
    $${PANEL}_others_curves using 1:2:3 with lines lw 0.8 lc rgb variable, \
    $${PANEL}_gnomon_curves using 1:2:3 with lines lw 1.8 lc rgb variable, \
    $${PANEL}_quartiles using 1:2:3:4:5 with xerrorbars pt 0 lw 0.7 lc rgb variable, \
    $${PANEL}_markers using 1:2:(1.06*$5):6:(0xffffff) with points pt variable ps variable lc rgb variable, \
    $${PANEL}_markers using 1:2:5:3:4 with points pt variable ps variable lw 1.3 lc rgb variable, \
    $${PANEL}_markers using 1:2:7 with labels hypertext point pt 7 ps 0.9 lc rgb "#ff000000"
