cat > car.urdf <<END
<robot name="car">
 <link name="body"><inertial><mass value="3"/><inertia ixx="0.1" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial></link>
 <link name="rotor"><inertial><origin xyz="0 0.001 0"/><mass value="0.2"/><inertia ixx="2e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
 <joint name="spin" type="continuous"><parent link="body"/><child link="rotor"/><origin xyz="0 0 0.1"/><axis xyz="0 0 1"/></joint>
</robot>
END
mahovik new car.urdf
mahovik check car.toml
sed 's/continuous/prismatic/' car.urdf > slider.urdf
mahovik new slider.urdf -o slider.toml
mahovik new car.urdf -o mjcf.toml
mahovik new missing.urdf
cat > pendulum.xml <<END
<mujoco model="pendulum">
 <worldbody>
  <body name="bar" pos="0 0 1">
   <joint name="pin" axis="0 1 0" damping="0.02" frictionloss="0.01" range="-60 60"/>
   <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.02"/>
   <body name="wheel" pos="0 0 -0.4">
    <joint name="spin" axis="0 1 0" armature="2e-6"/>
    <geom type="cylinder" zaxis="0 1 0" size="0.08 0.01"/>
   </body>
  </body>
 </worldbody>
 <actuator><motor joint="spin" ctrlrange="-0.2 0.2"/></actuator>
</mujoco>
END
mahovik new pendulum.xml
mahovik new pendulum.xml --armature wheel
cat pendulum.toml
