# Scaling plot of bench_networks' CSV: CPU time and peak memory against the number of grains.
# gnuplot -e "data='networks.csv'; picture='networks.svg'" networks.gp
set datafile separator comma
set terminal svg size 900,400 font "sans,11"
set output picture
set multiplot layout 1,2
set logscale xy
set xrange [800:130000]
set key bottom right
set xlabel "grains"
stem(name) = "<grep '^\"".name."/[0-9]' ".data." | tr -d '\"' | sed 's,^[a-z_]*/,,'"
set ylabel "CPU time [ms]"
plot stem("everything") using 1:4 with linespoints title "everything, 5 passes", \
     stem("five_trees") using 1:4 with linespoints title "5 spanning trees", \
     stem("force_networks") using 1:4 with linespoints title "force networks", \
     x*274./7601 with lines dashtype 2 linecolor "gray" title "linear", \
     500 with lines dashtype 3 linecolor "gray" title "0.5 s"
set ylabel "peak memory [bytes per grain]"
unset logscale y
set yrange [0:*]
plot stem("everything") using 1:12 with linespoints title "everything"
unset multiplot
