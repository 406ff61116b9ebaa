# Panels of the large grain's height once a cycle, at integer T: the base at its mean height, going up.
# The calling script draws each series by `rising(k)`; one line a replica, coloured by the value.
array hues[6] = [blue, vermillion, green, orange, '#CC79A7', '#56B4E9']
set xlabel 'cycle {/:Italic T}'
set ylabel 'height of the large grain  [{/:Italic d}_0]' offset 1
set key left top Left reverse samplen 1.5 font ',12'
set xrange [0:*]
set yrange [0:*]
set offsets 0, 0, graph 0.3, 0  # room for the key
set tmargin at screen 0.95
set bmargin at screen 0.14
# Height where a row belongs to this value and replica.
one_of(name, value, replica, who) = (strcol(name) eq value && column(who) == replica) ? 1 : 0
